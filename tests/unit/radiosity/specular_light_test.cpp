#include "radiosity/specular_light.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "math/statistics.h"
#include "radiosity/light_paths.h"
#include "radiosity/solve.h"
#include "support/statistics.h"
#include "unit/radiosity/all_sides.h"

namespace radfarm {
namespace {

using test::sum_of;

constexpr double kPi24 = 24 * std::numbers::pi;  // what lands in the furnace where E is pi, lm
constexpr double kBudget = 0.01;                 // of a solve, as in solve_test.cpp
constexpr std::size_t kTests = 10;               // of laws, in this file
const double kLevel = test::sidak_level(1e-6, kTests);

RadiositySettings quick(std::uint32_t hits = 4) {
  RadiositySettings settings;
  settings.max_link_error = 1e-3F;
  settings.min_patch_area = 1e-3F;
  settings.hits_per_patch = hits;
  return settings;
}

/// A scene without its emitters.
Scene darkened(Scene scene) {
  for (Material& material : scene.materials) material.emission = Spectrum();
  scene.lights.clear();
  return scene;
}

/// The same irradiance at the front of every triangle.
std::vector<Spectrum> on_fronts(const SideNumbers& sides, const Spectrum& irradiance) {
  std::vector<Spectrum> brought(sides.count);
  for (std::size_t s = 0; s < brought.size(); s += 2) brought[s] = irradiance;
  return brought;
}

/// All sides of a world in a hierarchy, and light on their fronts.
struct Brought {
  Brought(Scene scene, const Spectrum& on_each_front)
      : world(std::move(scene)),
        sides(world.scene),
        hierarchy(build_hierarchy(world, sides, std::vector<bool>(sides.count, true))),
        irradiance(on_fronts(sides, on_each_front)) {}
  FirstLight light() const { return {world, irradiance}; }

  const World world;
  const SideNumbers sides;
  Hierarchy hierarchy;
  std::vector<Spectrum> irradiance;
};

double luminous(const RadiositySolution& solution) { return luminance(SpectrumD(solution.reflected_power[0])); }

TEST(SpecularLight, AloneFillsAFurnace) {
  // E = 1 / (1 - rho) = 2 on 24 m^2: half of it is reflected, and what was brought is absorbed.
  const Brought furnace(darkened(test::own_scene("furnace")), Spectrum(1.0F));
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(furnace.light(), quick(hits), 1);
    EXPECT_NEAR(luminous(solution), 24, kBudget * 24);
    const EnergyLedger& energy = solution.energy;
    EXPECT_NEAR(energy.emitted, 24, 1e-5 * 24);
    EXPECT_NEAR(energy.absorbed, 24, kBudget * 24);
    EXPECT_NEAR(energy.absorbed + energy.escaped + energy.truncated, energy.emitted, 1e-9 * energy.emitted);
    EXPECT_LE(energy.truncated, 1.001e-3 * energy.emitted);
  }
}

TEST(SpecularLight, AddsToWhatEmittersSend) {
  // The emitters give E = pi, and as much is brought: 2 pi / (1 - rho), of which half is reflected.
  const Brought furnace(test::own_scene("furnace"), Spectrum(kPi));
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(furnace.light(), quick(hits), 1);
    EXPECT_NEAR(luminous(solution), 2 * kPi24, kBudget * 2 * kPi24);
    EXPECT_NEAR(solution.energy.emitted, 2 * kPi24, 1e-5 * kPi24);
    EXPECT_NEAR(solution.energy.absorbed, 2 * kPi24, kBudget * 2 * kPi24);
  }
}

/// A floor and a wall that share an edge, in two colours.
test::SceneMaker corner() {
  test::SceneMaker maker;
  const std::uint32_t floor = maker.material({0.8F, 0.5F, 0.2F}), wall = maker.material({0.3F, 0.6F, 0.9F});
  maker.polygon(floor, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  maker.polygon(wall, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  return maker;
}

using Channels = std::array<RunningStatistics, 3>;

Channels reflected_over_seeds(const FirstLight& light, std::uint32_t hits, std::uint64_t first_seed, std::uint64_t seeds) {
  Channels sums;
  for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
    const SpectrumD power(solve_radiosity(light, quick(hits), seed).reflected_power[0]);
    sums[0].add(power.r), sums[1].add(power.g), sums[2].add(power.b);
  }
  return sums;
}

TEST(SpecularLight, ReflectsAsDirectLightDoes) {
  // A direction lights both plates evenly, unhidden; so does what is brought. Means over seeds, by Student's law.
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::kDirectional;
  sun.direction = normalize(Vec3(-1, -1, 0));
  sun.intensity = {30, 20, 10};
  const World lit(corner().light(sun).take());
  const Brought brought(corner().take(), sun.intensity * std::sqrt(0.5F));
  constexpr std::uint64_t kSeeds = 24;
  const double deviations = student_t_quantile(1 - kLevel / 2, kSeeds - 1);
  for (const std::uint32_t hits : {0U, 16U}) {
    const Channels by_direct = reflected_over_seeds(lit, hits, 1, kSeeds);
    const Channels by_specular = reflected_over_seeds(brought.light(), hits, 1 + kSeeds, kSeeds);
    for (std::size_t c = 0; c < 3; ++c) {
      const double noise = deviations * std::hypot(by_direct[c].standard_error(), by_specular[c].standard_error());
      EXPECT_NEAR(by_specular[c].mean(), by_direct[c].mean(), noise) << hits << " hits, channel " << c;
      EXPECT_LT(noise, 0.05 * by_direct[c].mean());  // else the test says little
    }
  }
}

TEST(SpecularLight, NoneBroughtAndNothingBroughtHaveTheSameBits) {
  const World world(test::own_scene("cornell"));
  const std::vector<Spectrum> nothing(SideNumbers(world.scene).count);
  const RadiositySolution none = solve_radiosity(world, quick(), 7), zero = solve_radiosity({world, nothing}, quick(), 7);
  EXPECT_EQ(none.reflected_power, zero.reflected_power);
  EXPECT_EQ(none.links, zero.links);
  EXPECT_EQ(none.energy.emitted, zero.energy.emitted);
  EXPECT_EQ(none.energy.absorbed, zero.energy.absorbed);
}

TEST(SpecularLight, HasTheSameBitsForAnyNumberOfThreads) {
  const Brought cornell(test::own_scene("cornell"), {3, 2, 1});
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return solve_radiosity(cornell.light(), quick(), 7);
  };
  const RadiositySolution one = with(1), two = with(2);
  EXPECT_EQ(one.reflected_power, two.reflected_power);
  EXPECT_EQ(one.links, two.links);
  EXPECT_EQ(one.energy.absorbed, two.energy.absorbed);
}

TEST(SpecularLight, ReachesWhereNoEmitterDoes) {
  // The outside of the closed box is reached once something is brought to one side of it.
  Brought furnace(test::own_scene("furnace"), Spectrum());
  EXPECT_FALSE(reachable_sides(furnace.light(), furnace.sides, 1)[1]);
  furnace.irradiance[1] = Spectrum(1.0F);
  EXPECT_TRUE(reachable_sides(furnace.light(), furnace.sides, 1)[1]);
}

TEST(SpecularLight, PartsHaveTheIrradianceOfTheirSide) {
  Brought cornell(test::own_scene("cornell"), Spectrum(2.0F));
  subdivide(cornell.hierarchy, cornell.hierarchy.leaves[0]);
  const std::vector<Spectrum> irradiance = specular_irradiance(cornell.light(), cornell.sides, cornell.hierarchy);
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const Node& node = cornell.hierarchy.nodes[i];
    const bool is_lit = !node.is_cluster() && node.child_count == 0 && cornell.hierarchy.patches[node.patch].is_front != 0;
    EXPECT_EQ(irradiance[i], is_lit ? Spectrum(2.0F) : Spectrum());
  }
}

TEST(SpecularStarts, BringWhatSidesReceive) {
  Brought cornell(test::own_scene("cornell"), {1, 2, 3});
  cornell.irradiance[0] = {7, 0, 0};
  cornell.irradiance[1] = {0, 0, 5};  // a back
  SpectrumD truth;
  for (const std::uint32_t leaf : cornell.hierarchy.leaves) {
    const Node& node = cornell.hierarchy.nodes[leaf];
    const Patch& patch = cornell.hierarchy.patches[node.patch];
    truth += SpectrumD(cornell.irradiance[cornell.sides.of(patch.instance, patch.triangle, patch.is_front != 0)]) *
             static_cast<double>(node.area);
  }
  const SpecularStarts starts(cornell.light(), cornell.sides, cornell.hierarchy);
  EXPECT_NEAR(starts.flux(), luminance(truth), 1e-9 * luminance(truth));
  // Evenly spaced choices hit each side by its share to one in kCount; a side weighs at most its power over its luminance.
  constexpr int kCount = 1 << 16;
  SpectrumD sum;
  for (int i = 0; i < kCount; ++i) {
    const SpecularArrival arrival = starts.sample((i + 0.5) / kCount, {0.3F, 0.4F});
    sum += SpectrumD(arrival.power) / kCount;
    EXPECT_EQ(arrival.reflectance, cornell.world.surfaces.reflectance(arrival.point));  // nothing has holes
  }
  EXPECT_NEAR(sum.r, truth.r, 2e-3 * truth.r);
  EXPECT_NEAR(sum.g, truth.g, 2e-3 * truth.g);
  EXPECT_NEAR(sum.b, truth.b, 2e-3 * truth.b);
}

TEST(FollowLight, StartsWhereSpecularLightArrivesAsAtFirstSurfaces) {
  // As in light_paths_test.cpp: n surfaces with probability 2^-n, that of the start among them; each absorbs half.
  constexpr std::size_t kPaths = 1 << 20;
  const double error = kPi24 * std::sqrt(0.5 / kPaths);
  const Brought dark(darkened(test::own_scene("furnace")), Spectrum(kPi)), bright(test::own_scene("furnace"), Spectrum(kPi));
  for (const Brought* furnace : {&dark, &bright}) {
    const double flux = furnace == &dark ? kPi24 : 2 * kPi24, spread = error * flux / kPi24;
    const PathHits hits = follow_light(furnace->light(), furnace->sides, furnace->hierarchy, kPaths, 1);
    EXPECT_EQ(hits.escaped, 0);
    EXPECT_NEAR(luminance(hits.landed), flux, 1e-5 * flux);
    EXPECT_GT(test::z_test(hits.absorbed, spread, flux), kLevel) << hits.absorbed;
    EXPECT_GT(test::z_test(sum_of(hits.reflected), spread, flux / 2), kLevel) << sum_of(hits.reflected);
  }
}

}  // namespace
}  // namespace radfarm
