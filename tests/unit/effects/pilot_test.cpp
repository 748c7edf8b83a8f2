#include "effects/pilot.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

Pilot pilot_of(const World& world) { return run_pilot(world, world.scene.cameras.at(0), 64, 48, 1); }
Pilot pilot_of(const std::string& name) { return pilot_of(World(test::own_scene(name))); }

TEST(Pilot, NoWalkLeavesAClosedBox) {
  const Pilot pilot = pilot_of("furnace");
  EXPECT_EQ(pilot.rays, 4096U);
  EXPECT_EQ(pilot.hits, pilot.rays);
  EXPECT_EQ(pilot.walks, pilot.rays);
  EXPECT_EQ(pilot.escaped, 0U);
  EXPECT_EQ(pilot.met, pilot.bounces);
  EXPECT_EQ(pilot.escapes_at_most(), 3.0 / 4096);
  EXPECT_EQ(pilot.meets_at_most(), 1);
}

TEST(Pilot, WalksLeaveAnOpenScene) {
  const Pilot pilot = pilot_of("effects/open_plane_sky");
  EXPECT_EQ(pilot.walks, 0U) << "no light, nothing to find";
  const Pilot lit = pilot_of("effects/none");
  EXPECT_GT(lit.escaped, 0U);
  EXPECT_GT(lit.direct_radiance, 0);
}

TEST(Pilot, AConvexObjectMeetsNothingThatReflects) {
  const Pilot pilot = pilot_of("effects/convex_object");
  EXPECT_GT(pilot.bounces, 100U);
  EXPECT_EQ(pilot.met, 0U);
  EXPECT_EQ(pilot.met_radiance, 0);
  EXPECT_EQ(pilot.meets_at_most(), 3.0 / pilot.bounces);
}

TEST(Pilot, IsTheSameForTheSameSeed) {
  const World world(test::own_scene("effects/glossy_floor"));
  const Pilot once = pilot_of(world), again = pilot_of(world);
  EXPECT_EQ(once.direct_radiance, again.direct_radiance);
  EXPECT_EQ(once.met, again.met);
  EXPECT_EQ(once.escaped, again.escaped);
  EXPECT_GT(once.specular_share, 0);
}

TEST(Pilot, BlurIsTheCircleOfConfusionInPixels) {
  // A wall 4 m away, seen square on; sharp at 2 m.
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F), Spectrum(1.0F)), {{-9, -9, -4}, {9, -9, -4}, {9, 9, -4}, {-9, 9, -4}});
  const World world(maker.take());
  Camera camera;
  camera.lens_diameter = 0.1F;
  camera.focus_distance = 2;
  // A pixel at 4 m is 2 x 4 tan(fov / 2) / 48 m high; the circle there is 0.1 (4 - 2) / 2 m.
  const double pixel = 2 * 4 * std::tan(static_cast<double>(camera.vertical_fov) / 2) / 48;
  EXPECT_NEAR(run_pilot(world, camera, 64, 48, 1).max_blur, 0.1 / pixel, 1e-3);
  camera.focus_distance = 4;
  EXPECT_NEAR(run_pilot(world, camera, 64, 48, 1).max_blur, 0, 1e-3);
  camera.lens_diameter = 0;
  EXPECT_EQ(run_pilot(world, camera, 64, 48, 1).max_blur, 0);
}

TEST(Pilot, UpperEndsAreWilsonsAndTheRuleOfThree) {
  Pilot pilot;
  EXPECT_EQ(pilot.meets_at_most(), 1) << "nothing known";
  pilot.bounces = 1000;
  EXPECT_EQ(pilot.meets_at_most(), 0.003);
  pilot.met = 500;
  // Wilson: (p + z/2 + k sqrt(p (1 - p) / n + z / (4 n))) / (1 + z), k = 1.645, z = k^2 / n.
  EXPECT_NEAR(pilot.meets_at_most(), 0.525975, 1e-5);
  pilot.met = 1000;
  EXPECT_EQ(pilot.meets_at_most(), 1);
}

}  // namespace
}  // namespace radfarm
