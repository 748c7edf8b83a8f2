#include "radiosity/specular_light.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "radiosity/irradiance.h"
#include "radiosity/light_paths.h"
#include "radiosity/solve.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

// effects/glowing_box: five walls of 4 m^2, L_e 1 and rho .5, and a perfect mirror: radiance is 2 everywhere, so that
// each wall has E = 2 pi, of which those that face the mirror have some by it.
constexpr double kGlowing = 20;  // m^2
constexpr double kBudget = 0.02;

RadiositySettings quick(std::uint32_t hits = 4) {
  RadiositySettings settings;
  settings.max_link_error = 1e-3F;
  settings.min_patch_area = 1e-3F;
  settings.hits_per_patch = hits;
  return settings;
}

double luminous(const RadiositySolution& solution) { return luminance(SpectrumD(solution.reflected_power[0])); }

/// All that sides receive from specular surfaces, lm.
double flux_of(const World& world, const SideNumbers& sides, const std::vector<Spectrum>& irradiance) {
  double flux = 0;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const auto triangles = world.scene.meshes[world.scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < triangles; ++t) {
      const TriangleVertices p = world.surfaces.triangle(i, t);
      const auto area = static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0])) / 2);
      for (const bool front : {true, false}) flux += static_cast<double>(luminance(irradiance[sides.of(i, t, front)])) * area;
    }
  }
  return flux;
}

TEST(SpecularIrradiance, IsWhatAMirrorSendsOn) {
  // The mirror's 4 m^2 receive E = 2 pi and send all of it to the other walls.
  const World world(test::own_scene("effects/glowing_box"));
  const SideNumbers sides(world.scene);
  const std::vector<Spectrum> irradiance = specular_irradiance(world, sides, 1);
  ASSERT_EQ(irradiance.size(), sides.count);
  EXPECT_NEAR(flux_of(world, sides, irradiance), 8 * std::numbers::pi, kBudget * 8 * std::numbers::pi);
}

TEST(SpecularIrradiance, IsNothingWhereGlossIsFoldedOrThereIsNone) {
  Scene scene = test::own_scene("effects/glowing_box");
  for (Material& material : scene.materials) material.folds_specular = true;
  const World folded(std::move(scene)), diffuse(test::own_scene("cornell"));
  EXPECT_TRUE(specular_irradiance(folded, SideNumbers(folded.scene), 1).empty());
  EXPECT_TRUE(specular_irradiance(diffuse, SideNumbers(diffuse.scene), 1).empty());
}

TEST(SpecularIrradiance, HasTheSameBitsForAnyNumberOfThreads) {
  const World world(test::own_scene("effects/globe"));
  const SideNumbers sides(world.scene);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return specular_irradiance(world, sides, 7);
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(SpecularAtPatches, PartsHaveTheIrradianceOfTheirSide) {
  const World world(test::own_scene("cornell"));
  const SideNumbers sides(world.scene);
  Hierarchy hierarchy = build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
  std::vector<Spectrum> of_sides(sides.count);
  for (std::size_t s = 0; s < of_sides.size(); s += 2) of_sides[s] = Spectrum(2.0F);
  subdivide(hierarchy, hierarchy.leaves[0]);
  const std::vector<Spectrum> at = specular_at_patches(of_sides, sides, hierarchy);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    const bool is_lit = !node.is_cluster() && node.child_count == 0 && hierarchy.patches[node.patch].is_front != 0;
    EXPECT_EQ(at[i], is_lit ? Spectrum(2.0F) : Spectrum());
  }
}

TEST(FollowLight, GoesOnByMirrors) {
  // Luminous flux 20 pi; each glowing wall absorbs half of E = 2 pi on 20 m^2; what it reflects of light that it has
  // not straight from emitters is rho (2 pi - E_direct).
  const World world(test::own_scene("effects/glowing_box"));
  const SideNumbers sides(world.scene);
  const Hierarchy hierarchy = build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
  const PathHits hits = follow_light(world, sides, hierarchy, 1 << 18, 1);
  EXPECT_EQ(hits.escaped, 0);
  EXPECT_NEAR(hits.absorbed, kGlowing * std::numbers::pi, kBudget * kGlowing * std::numbers::pi);
}

TEST(SolveRadiosity, AMirrorInABoxNeitherTakesNorMakesLight) {
  const World world(test::own_scene("effects/glowing_box"));
  const double reflected = kGlowing * std::numbers::pi;  // rho E A
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(world, quick(hits), 1);
    EXPECT_NEAR(luminous(solution), reflected, kBudget * reflected) << hits;
    EXPECT_NEAR(solution.energy.absorbed + solution.energy.escaped + solution.energy.truncated, solution.energy.emitted,
                1e-9 * solution.energy.emitted);
  }
  const EnergyLedger energy = solve_radiosity(world, quick(4), 1).energy;
  EXPECT_NEAR(energy.emitted, kGlowing * std::numbers::pi, 1e-4 * kGlowing);
}

TEST(GatherIrradiance, HasWhatMirrorsBring) {
  const World world(test::own_scene("effects/glowing_box"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  const std::vector<Irradiance> irradiance = gather_irradiance(world, solution, kGatherRays, 1);
  double flux = 0, area = 0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const Node& node = solution.hierarchy.nodes[i];
    if (!is_undivided(node) || solution.hierarchy.patches[node.patch].is_front == 0 || is_black(node.reflectance)) continue;
    flux += static_cast<double>(luminance(irradiance[i].total()) * node.area), area += static_cast<double>(node.area);
  }
  EXPECT_NEAR(area, kGlowing, 1e-4);
  EXPECT_NEAR(flux / area, 2 * std::numbers::pi, kBudget * 2 * std::numbers::pi);
}

}  // namespace
}  // namespace radfarm
