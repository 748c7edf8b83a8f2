#include "rpc/retry.h"

#include <gtest/gtest.h>

namespace radfarm::rpc {
namespace {

using std::chrono::milliseconds;

bool go_on(milliseconds) { return true; }

TEST(Backoff, DoublesUpToTheLongestWaitAndIsScatteredOverItsUpperHalf) {
  const RetryPolicy policy{milliseconds(100), milliseconds(1000), milliseconds(5000)};
  EXPECT_EQ(backoff(policy, 1, 0), milliseconds(50));
  EXPECT_EQ(backoff(policy, 1, 49), milliseconds(99));
  EXPECT_EQ(backoff(policy, 2, 0), milliseconds(100));
  EXPECT_EQ(backoff(policy, 1000, 0), milliseconds(500));
}

TEST(WithRetries, RepeatsUnavailableUntilAnAnswer) {
  int calls = 0;
  const Status status = with_retries({}, go_on, [&]() -> Status {
    if (++calls < 4) return fail(Code::kUnavailable, "starting");
    return {};
  });
  EXPECT_TRUE(status);
  EXPECT_EQ(calls, 4);
}

TEST(WithRetries, AnyOtherErrorIsAnAnswer) {
  int calls = 0;
  const Status status = with_retries({}, go_on, [&]() -> Status {
    ++calls;
    return fail(Code::kResourceExhausted, "full");
  });
  EXPECT_EQ(status.error().code, Code::kResourceExhausted);
  EXPECT_EQ(calls, 1);
}

TEST(WithRetries, GivesUpAfterThePolicysTime) {
  milliseconds waited{0};
  const RetryPolicy policy{milliseconds(100), milliseconds(400), milliseconds(2000)};
  const auto count = [&](milliseconds wait) {
    waited += wait;
    return true;
  };
  const Status status = with_retries(policy, count, []() -> Status { return fail(Code::kUnavailable, "gone"); });
  EXPECT_EQ(status.error().code, Code::kUnavailable);
  EXPECT_LE(waited, milliseconds(2000));
  EXPECT_GT(waited, milliseconds(1500));
}

TEST(WithRetries, StopsWhenThePauseSaysSo) {
  int calls = 0;
  const Status status = with_retries(
      {}, [](milliseconds) { return false; },
      [&]() -> Status {
        ++calls;
        return fail(Code::kUnavailable, "gone");
      });
  EXPECT_FALSE(status);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace radfarm::rpc
