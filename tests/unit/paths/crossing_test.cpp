#include "paths/crossing.h"

#include <numbers>

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

TEST(Crossing, DiscSegmentsAreTheTables) {  // O16
  constexpr double kPiD = std::numbers::pi;
  EXPECT_NEAR(disc_segment(0) / kPiD, .5, 1e-12);
  EXPECT_NEAR(disc_segment(.25) / kPiD, .657481, 1e-6);
  EXPECT_NEAR(disc_segment(.5) / kPiD, .804499, 1e-6);
  EXPECT_NEAR(disc_segment(.75) / kPiD, .927853, 1e-6);
  EXPECT_EQ(disc_segment(1), kPiD);
  EXPECT_EQ(disc_segment(1e300), kPiD);
  EXPECT_EQ(disc_segment(-2), 0);
}

struct InAir {
  World world{test::SceneMaker().take()};
  Components components{world.scene};
  DiscSet set{world, components, {disc_in_air({0, 0, 0}, {0, 1, 0}, 1)}};
  CountedArea at(const Segment& segment) const { return Crossing(world, set, segment).at(0); }
};

Segment down(float x, float height = 2) {
  Segment s;
  s.ray = {{x, height, 0}, {0, -1, 0}};
  return s;
}

TEST(Crossing, CountsFromTheFrontWithinTheDisc) {
  const InAir air;
  EXPECT_NEAR(air.at(down(.5F)).whole, std::numbers::pi, 1e-9);
  EXPECT_NEAR(air.at(down(.5F)).inner, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(air.at(down(.8F)).inner, 0);
  EXPECT_EQ(air.at(down(1.01F)).whole, 0);
  Segment up = down(.5F, -2);
  up.ray.direction.y = 1;
  EXPECT_EQ(air.at(up).whole, 0);
  Segment late = down(.5F);
  late.begin = 3;  // begins behind the disc
  EXPECT_EQ(air.at(late).whole, 0);
}

TEST(Crossing, AnOriginReachesItsSideOfThePlaneOnly) {
  const InAir air;
  Segment wall = down(.5F);
  wall.plane = {1, 0, 0};  // the wall x = .5 sends towards x > .5: the centre is behind it
  EXPECT_EQ(air.at(wall).whole, 0);
  wall = down(-.5F);  // the wall x = -.5 reaches all but a segment at half the radius
  wall.ray.direction = normalize(Vec3(.1F, -1, 0));
  wall.plane = {1, 0, 0};
  EXPECT_NEAR(air.at(wall).whole, .804499 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace radfarm
