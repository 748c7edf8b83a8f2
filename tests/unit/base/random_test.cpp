#include "base/random.h"

#include <bit>
#include <set>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Random, CombineDependsOnOrderAndOnEveryValue) {
  EXPECT_NE(combine(1, 2), combine(2, 1));
  EXPECT_NE(combine(0, 0), combine(0, 1));
  EXPECT_NE(combine(0, 0, 0), combine(0, 0));
  EXPECT_EQ(combine(1, 2, 3), combine(combine(1, 2), 3));
  std::set<std::uint64_t> keys;
  for (std::uint64_t i = 0; i < 300; ++i) {
    for (std::uint64_t j = 0; j < 300; ++j) keys.insert(combine(i, j));
  }
  EXPECT_EQ(keys.size(), 90'000U);
}

TEST(Random, OneInputBitFlipsAboutHalfOfTheOutput) {
  for (int bit = 0; bit < 64; ++bit) {
    int flips = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) flips += std::popcount(combine(9, i) ^ combine(9, i ^ (1ULL << bit)));
    EXPECT_NEAR(flips / 1000.0, 32, 1) << bit;  // 8 standard deviations of the mean of 1000 binomials
  }
}

TEST(Random, UnitIntervalIsHalfOpen) {
  EXPECT_EQ(to_unit_float(0), 0.0F);
  EXPECT_LT(to_unit_float(~0ULL), 1.0F);
  EXPECT_EQ(to_unit_double(0), 0.0);
  EXPECT_LT(to_unit_double(~0ULL), 1.0);
}

TEST(Random, SequenceIsAFunctionOfItsKey) {
  RandomSequence a(5), b(5), c(6);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.bits(), b.bits());
  EXPECT_NE(RandomSequence(5).bits(), c.bits());
}

}  // namespace
}  // namespace radfarm
