#include "worker/held_leases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

Lease lease(const std::string& token) { return {"job", 0, {}, {}, 1, token}; }

TEST(HeldLeases, RunInTheOrderTheyCame) {
  HeldLeases held;
  held.add({lease("a"), lease("b")});
  EXPECT_EQ(held.start()->token, "a");
  EXPECT_EQ(held.size(), 2U);
  EXPECT_THAT(held.tokens(), UnorderedElementsAre("a", "b"));
  held.done("a");
  EXPECT_EQ(held.start()->token, "b");
  EXPECT_EQ(held.start(), std::nullopt);
  EXPECT_EQ(held.size(), 1U);
}

TEST(HeldLeases, LostOnesAreNotRunNorRenewedNorHandedIn) {
  HeldLeases held;
  held.add({lease("a"), lease("b")});
  held.start();
  EXPECT_TRUE(held.is_current("a"));
  held.lose({"a", "b", "never held"});
  EXPECT_FALSE(held.is_current("a"));
  EXPECT_FALSE(held.has_waiting());
  EXPECT_THAT(held.tokens(), IsEmpty());
  EXPECT_EQ(held.size(), 1U) << "the thread is still busy with it";
  held.done("a");
  EXPECT_EQ(held.size(), 0U);
}

TEST(HeldLeases, WaitingOnesCanBeHandedBack) {
  HeldLeases held;
  held.add({lease("a"), lease("b"), lease("c")});
  held.start();
  EXPECT_EQ(held.drop_waiting().size(), 2U);
  EXPECT_THAT(held.tokens(), UnorderedElementsAre("a"));
}

}  // namespace
}  // namespace radfarm
