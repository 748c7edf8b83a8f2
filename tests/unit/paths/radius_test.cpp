#include "paths/radius.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Radius, BringsAsManyCrossingsAsAreAskedFor) {
  const Disc disc = disc_in_air({0, 0, 0}, {0, 1, 0}, .2F);
  DiscSums pilot;
  pilot.crossings = 100;
  // 100 of 1000 paths at .2 m; of 10000 paths 1000: 250 need a quarter of the area.
  EXPECT_NEAR(choose_radius(disc, pilot, 1000, 10000, {250, .01F, 1}), .1F, 1e-6F);
  EXPECT_EQ(choose_radius(disc, pilot, 1000, 10000, {250, .15F, 1}), .15F);
  EXPECT_EQ(choose_radius(disc, pilot, 1000, 10000, {1e9, .01F, 1}), 1);
  EXPECT_EQ(choose_radius(disc, DiscSums(), 1000, 10000, {250, .01F, .3F}), .3F);
}

}  // namespace
}  // namespace radfarm
