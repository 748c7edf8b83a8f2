#include "base/parallel.h"

#include <mutex>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

std::set<std::pair<std::size_t, std::size_t>> pieces_with(int threads, std::size_t count, std::size_t grain) {
  const ThreadLimit limit(threads);
  std::mutex mutex;
  std::set<std::pair<std::size_t, std::size_t>> pieces;
  parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
    const std::scoped_lock lock(mutex);
    EXPECT_TRUE(pieces.emplace(begin, end).second);
  });
  return pieces;
}

TEST(ParallelFor, EveryIndexIsVisitedOnce) {
  for (const std::size_t count : {0U, 1U, 7U, 64U, 1000U}) {
    std::vector<int> visits(count);
    parallel_for(count, 7, [&](std::size_t begin, std::size_t end) {
      EXPECT_LE(end - begin, 7U);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST(ParallelFor, PiecesDoNotDependOnTheThreads) {
  EXPECT_EQ(pieces_with(1, 1003, 16), pieces_with(4, 1003, 16));
  EXPECT_EQ(pieces_with(1, 1003, 16).size(), 63U);
}

TEST(ParallelFor, SumsKeptPerPieceAreTheSameBits) {
  const auto sum = [](int threads) {
    const ThreadLimit limit(threads);
    std::vector<float> partial(100);
    parallel_for(10'000, 100, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) partial[begin / 100] += 1.0F / static_cast<float>(i + 1);
    });
    return std::accumulate(partial.begin(), partial.end(), 0.0F);
  };
  EXPECT_EQ(sum(1), sum(3));
}

}  // namespace
}  // namespace radfarm
