#include "pipeline/fingerprint.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(NumericFingerprint, IsTheSameEachTime) { EXPECT_EQ(numeric_fingerprint(), numeric_fingerprint()); }

TEST(NumericFingerprint, DependsOnTheRayCastersNameAndOnEachBitOfItsHits) {
  const RaySelfTest rays = ray_self_test();
  const std::string ours = numeric_fingerprint(rays);
  EXPECT_EQ(ours, numeric_fingerprint());
  RaySelfTest other = rays;
  other.caster += "1";
  EXPECT_NE(numeric_fingerprint(other), ours);
  for (float Hit::*member : {&Hit::u, &Hit::v, &Hit::distance}) {
    other = rays;
    other.hits.back().*member = std::nextafter(other.hits.back().*member, 2.0F);
    EXPECT_NE(numeric_fingerprint(other), ours);
  }
  other = rays;
  other.hits.front().triangle += 1;
  EXPECT_NE(numeric_fingerprint(other), ours);
}

TEST(RaySelfTest, HasHitsAndMisses) {
  const RaySelfTest rays = ray_self_test();
  EXPECT_FALSE(rays.caster.empty());
  ASSERT_EQ(rays.hits.size(), 64U);
  const auto hits = std::count_if(rays.hits.begin(), rays.hits.end(), [](const Hit& h) { return h.triangle != kNone; });
  EXPECT_GE(hits, 32);
  EXPECT_LT(hits, 64);
}

}  // namespace
}  // namespace radfarm
