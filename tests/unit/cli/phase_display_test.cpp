#include "cli/phase_display.h"

#include <stop_token>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

/// How often `part` stands in `text`.
std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(PhaseDisplay, WritesALineForEachNewPhase) {
  ::testing::internal::CaptureStderr();
  {
    PhaseDisplay display(Progress::Style::kLines, JobState::kPreparing);
    const radfarm::Progress progress = display.progress();
    progress.report("load");
    std::thread other([&] {
      for (std::uint64_t i = 0; i < 100; ++i) progress.report("links", i, 100);
    });
    other.join();
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(count_of(text, "preparing  load"), 1U) << text;
  EXPECT_EQ(count_of(text, "preparing  links"), 1U) << text;
  EXPECT_EQ(count_of(text, "\n"), 2U) << text;
}

TEST(PhaseDisplay, TheLastStepIsDrawnOnATerminalBeforeTheLineEnds) {
  ::testing::internal::CaptureStderr();
  {
    PhaseDisplay display(Progress::Style::kBar, JobState::kPreparing);
    display.show("links", 1, 100);
    display.show("links", 99, 100);
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_GE(count_of(text, "links 99/100"), 1U) << text;  // a tick may come in between
  EXPECT_EQ(count_of(text, "\n"), 1U) << text;
}

TEST(PhaseDisplay, ItsProgressIsCancelledByTheToken) {
  std::stop_source stop;
  PhaseDisplay display(Progress::Style::kLines, JobState::kPreparing);
  const radfarm::Progress progress = display.progress(stop.get_token());
  EXPECT_TRUE(progress.check());
  stop.request_stop();
  EXPECT_EQ(progress.check().error().code, Code::kCancelled);
}

}  // namespace
}  // namespace radfarm::cli
