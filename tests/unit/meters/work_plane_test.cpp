#include "meters/work_plane.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using test::SceneMaker;

/// A room 4 x 3 m under a roof, on a slab that goes on 1 m beyond its walls.
SceneMaker room_on_slab(std::uint32_t& grey) {
  SceneMaker maker;
  grey = maker.material(Spectrum(.5F), Spectrum(1.0F));
  maker.room(std::vector<std::uint32_t>(6, grey), {0, 0, 0}, {4, 2.5F, 3});
  maker.polygon(grey, {{-1, -.001F, -1}, {-1, -.001F, 4}, {5, -.001F, 4}, {5, -.001F, -1}});
  return maker;
}

TEST(WorkPlane, CoversTheFloorInsideTheWalls) {
  std::uint32_t grey = 0;
  const World world(room_on_slab(grey).take());
  const auto plane = make_work_plane(world, {.85F, .5F, {}});
  ASSERT_TRUE(plane) << plane.error().message;
  EXPECT_NEAR(plane->floor, 0, .01);
  EXPECT_EQ(plane->meters.size(), 8U * 6U);
  for (const Meter& meter : plane->meters) {
    EXPECT_GT(meter.point.x, 0);
    EXPECT_LT(meter.point.z, 3);
    EXPECT_NEAR(meter.point.y, .85F, .01F);
  }
}

TEST(WorkPlane, LeavesOutSolidsAndCupboardsButNotTables) {
  std::uint32_t grey = 0;
  SceneMaker maker = room_on_slab(grey);
  const test::Shape pillar = test::box({1, 0, 1}, {1.5F, 2.5F, 1.5F});
  maker.mesh(grey, pillar.positions, pillar.triangles);
  maker.room(std::vector<std::uint32_t>(6, grey), {3, .01F, 2}, {3.5F, 2, 3});  // hollow: .5 m^2
  maker.polygon(grey, {{2, .7F, 0}, {2, .7F, 1}, {3, .7F, 1}, {3, .7F, 0}});    // a table
  const World world(maker.take());
  const auto plane = make_work_plane(world, {.85F, .5F, {}});
  ASSERT_TRUE(plane) << plane.error().message;
  EXPECT_EQ(plane->meters.size(), 8U * 6U - 1U - 2U);
}

TEST(WorkPlane, RefusesWhatHasNoFloor) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F), Spectrum(1.0F));
  maker.polygon(grey, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  const World wall(maker.take());
  EXPECT_THAT(make_work_plane(wall, {}).error().message, testing::HasSubstr("no floor"));
  std::uint32_t other = 0;
  const World room(room_on_slab(other).take());
  EXPECT_THAT(make_work_plane(room, {.85F, .5F, 1.0F}).error().message, testing::HasSubstr("--floor"));
  EXPECT_THAT(make_work_plane(room, {.85F, 1e-4F, {}}).error().message, testing::HasSubstr("--spacing"));
}

}  // namespace
}  // namespace radfarm
