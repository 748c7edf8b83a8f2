#include "estimate/gouraud.h"

#include <string>

#include <gtest/gtest.h>

#include "estimate/mesh_lines.h"
#include "statistical/rendered_view.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

// As of the gather (gather_test.cpp): what radiosity and its interpolation may be off in the mean, and standard errors on top.
constexpr double kBias = 0.03;
constexpr double kErrors = 4;

class GouraudOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GouraudOf, testing::Values("furnace", "cornell", "room", "point_light", "emitters_reflect"));

TEST_P(GouraudOf, HasTheMeanLightOfAPathTrace) {
  const World world(test::own_scene(GetParam()));
  const Film film{world.scene.cameras.at(0), 48, 36, 1};
  RadiositySettings settings;
  settings.max_link_error = 2e-5F;  // of standard quality
  const RadiositySolution solution = solve_radiosity(world, settings, film.seed);
  const ElementMesh mesh =
      make_element_mesh(world, solution.hierarchy, gather_irradiance(world, solution, kGatherRays, film.seed));
  const SideNumbers sides(world.scene);
  const GouraudContext context{world, mesh, sides};
  const test::Mean shown = test::mean_of(film, 16, [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) {
    return gouraud_radiance(context, ray, sampler, c);
  });
  const test::Mean traced = test::path_traced(world, film, 128);
  EXPECT_EQ(shown.dropped, 0U);
  ASSERT_GT(traced.value, 0);
  EXPECT_NEAR(shown.value, traced.value, kBias * traced.value + kErrors * std::hypot(shown.error, traced.error));
}

// Ten pixels a metre, seen straight on and from the side: there lines across the slope come closer together.
TEST(MeshLines, AreAsFarAsTheyAreOnTheFilm) {
  Film film;
  film.camera.kind = Camera::Kind::kOrthographic;
  film.camera.half_height = 5;
  film.width = film.height = 100;
  const TriangleVertices flat = {Vec3(-4, -4, -10), Vec3(4, -4, -10), Vec3(-4, 4, -10)};
  EXPECT_NEAR(pixels_to_edge(flat, {-3.9F, -2, -10}, film), 1, 1e-4F);
  EXPECT_NEAR(pixels_to_edge(flat, {-2, -3.8F, -10}, film), 2, 1e-4F);
  const TriangleVertices tilted = {Vec3(-4, -4, -10), Vec3(4, -4, -26), Vec3(-4, 4, -10)};
  EXPECT_NEAR(pixels_to_edge(tilted, {-3.9F, -2, -10.2F}, film), 1, 1e-4F);
}

}  // namespace
}  // namespace radfarm
