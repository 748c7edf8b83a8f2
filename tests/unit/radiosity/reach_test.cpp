#include "radiosity/reach.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

/// A closed cube with outward faces, six polygons.
void add_cube(test::SceneMaker& maker, std::uint32_t m, const Vec3& low, const Vec3& high) {
  const Vec3 l = low, h = high;
  maker.polygon(m, {{l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z}});
  maker.polygon(m, {{l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}});
  maker.polygon(m, {{l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z}});
  maker.polygon(m, {{h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z}});
  maker.polygon(m, {{l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z}});
  maker.polygon(m, {{l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z}});
}

TEST(Reach, StopsAtClosedFurnitureAndAtTheRoomsOutside) {
  test::SceneMaker maker;
  const std::uint32_t wall = maker.material(Spectrum(0.5F)), lamp = maker.material(Spectrum(), Spectrum(1.0F));
  maker.room({wall, lamp, wall, wall, wall, wall}, {0, 0, 0}, {4, 3, 4});
  add_cube(maker, wall, {1, 1, 1}, {2, 2, 2});
  const World world(maker.take());
  const SideNumbers sides(world.scene);
  ASSERT_EQ(sides.count, 48U);
  const std::vector<bool> reached = reachable_sides(world, sides, 1);
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    for (std::uint32_t t = 0; t < 2; ++t) {
      EXPECT_TRUE(reached[sides.of(i, t, true)]) << i;
      EXPECT_FALSE(reached[sides.of(i, t, false)]) << i;
    }
  }
}

TEST(Reach, GoesRoundAnOpenSheet) {
  test::SceneMaker maker;
  const std::uint32_t wall = maker.material(Spectrum(0.5F)), lamp = maker.material(Spectrum(), Spectrum(1.0F));
  maker.room({wall, lamp, wall, wall, wall, wall}, {0, 0, 0}, {4, 3, 4});
  maker.polygon(wall, {{1, 1, 1}, {2, 1, 1}, {2, 1, 2}, {1, 1, 2}});
  const World world(maker.take());
  const SideNumbers sides(world.scene);
  const std::vector<bool> reached = reachable_sides(world, sides, 1);
  for (const bool front : {true, false}) {
    EXPECT_TRUE(reached[sides.of(6, 0, front)]);
    EXPECT_TRUE(reached[sides.of(6, 1, front)]);
  }
}

TEST(Reach, DarkChamberOfTheSheetIsNotReached) {
  const World world(test::own_scene("sheet"));
  const SideNumbers sides(world.scene);
  const std::vector<bool> reached = reachable_sides(world, sides, 1);
  const float middle = static_cast<float>(1 - world.scene.origin.x);
  std::size_t lit = 0;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const Mesh& mesh = world.scene.meshes[world.scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const TriangleVertices v = world.surfaces.triangle(i, t);
      const float x = (v[0].x + v[1].x + v[2].x) / 3;
      const Vec3 normal = world.surfaces.at({i, t, 0.3F, 0.3F, 0}).geometric_normal;
      const bool in_sheet = std::abs(x - middle) < 1e-5F;
      for (const bool front : {true, false}) {
        // Of the wall between, only the side that looks into the lit chamber; of the rest, what looks inwards there.
        const float side = front ? 1.0F : -1.0F;
        const bool is_lit = in_sheet ? side * normal.x < 0 : x < middle && front;
        EXPECT_EQ(reached[sides.of(i, t, front)], is_lit) << i << ' ' << t << ' ' << front;
        lit += is_lit ? 1 : 0;
      }
    }
  }
  EXPECT_GT(lit, 0U);
}

TEST(Reach, APunctualLightReachesWhatItShinesOn) {
  const World world(test::own_scene("point_light"));
  const SideNumbers sides(world.scene);
  const std::vector<bool> reached = reachable_sides(world, sides, 1);
  EXPECT_TRUE(reached[sides.of(0, 0, true)]);
  EXPECT_TRUE(reached[sides.of(0, 1, true)]);
  EXPECT_FALSE(reached[sides.of(0, 0, false)]);
}

TEST(Reach, IsTheSameForAnyNumberOfThreads) {
  const World world(test::own_scene("room"));
  const SideNumbers sides(world.scene);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return reachable_sides(world, sides, 3);
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(Reach, ALampTooFarAwayForRaysToMeetReachesWhatSeesIt) {
  test::SceneMaker maker;
  const std::uint32_t lamp = maker.material(Spectrum(0.0F), Spectrum(1.0F)), grey = maker.material(Spectrum(0.5F));
  maker.polygon(lamp, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  maker.polygon(grey, {{0, 1000, 0}, {1, 1000, 0}, {1, 1000, 1}, {0, 1000, 1}});
  const World world(maker.take());
  const SideNumbers sides(world.scene);
  const std::vector<bool> reached = reachable_sides(world, sides, 1);
  for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
    EXPECT_TRUE(reached[sides.of(1, triangle, true)]);
    EXPECT_FALSE(reached[sides.of(1, triangle, false)]) << "looks away";
    EXPECT_FALSE(reached[sides.of(0, triangle, false)]) << "the lamp's back";
  }
}

}  // namespace
}  // namespace radfarm
