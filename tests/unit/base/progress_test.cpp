#include "base/progress.h"

#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel.h"

namespace radfarm {
namespace {

TEST(Progress, OneThatNobodyWaitsForIsSilentAndNeverCancelled) {
  const Progress progress;
  progress.report("senders", 1, 2);
  EXPECT_TRUE(progress.check());
  std::vector<int> visits(100);
  parallel_for(progress, "senders", visits.size(), 7, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
}

TEST(Progress, ParallelForTellsHowMuchIsDone) {
  std::mutex mutex;
  std::uint64_t most = 0, first = 1;
  const Progress progress([&](std::string_view phase, std::uint64_t done, std::uint64_t total) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(phase, "paths");
    EXPECT_EQ(total, 100U);
    first = std::min(first, done);
    most = std::max(most, done);
  });
  parallel_for(progress, "paths", 100, 7, [](std::size_t, std::size_t) {});
  EXPECT_EQ(first, 0U);
  EXPECT_EQ(most, 100U);
}

TEST(Progress, ParallelForBeginsNothingOnceCancelled) {
  const ThreadLimit limit(1);
  std::stop_source stop;
  const Progress progress([](std::string_view, std::uint64_t, std::uint64_t) {}, stop.get_token());
  std::size_t pieces = 0;
  parallel_for(progress, "paths", 100, 1, [&](std::size_t, std::size_t) {
    if (++pieces == 3) stop.request_stop();
  });
  EXPECT_EQ(pieces, 3U);
  EXPECT_EQ(progress.check().error().code, Code::kCancelled);
}

}  // namespace
}  // namespace radfarm
