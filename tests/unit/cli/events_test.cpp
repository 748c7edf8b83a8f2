#include "cli/events.h"

#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

TEST(Events, TheEndOfOneJobsWatchIsNothingToTheNext) {
  Events events;
  events.job({});
  events.lose({Code::kCancelled, "the watch was stopped"});
  events.forget_job();
  events.child_ended();  // so that there is something to see
  const Events::Seen seen = events.wait(std::nullopt);
  EXPECT_FALSE(seen.lost);
  EXPECT_FALSE(seen.job);
  EXPECT_TRUE(seen.child_ended);
}

TEST(Events, AnInterruptionIsNotForgotten) {
  Events events;
  events.interrupt();
  events.forget_job();
  EXPECT_TRUE(events.wait(std::nullopt).interrupted);
  EXPECT_TRUE(events.interruption().stop_requested());
}

}  // namespace
}  // namespace radfarm::cli
