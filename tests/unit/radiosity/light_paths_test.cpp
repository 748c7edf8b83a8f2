#include "radiosity/light_paths.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "math/statistics.h"
#include "radiosity/solve.h"
#include "support/statistics.h"
#include "unit/radiosity/all_sides.h"

namespace radfarm {
namespace {

using test::Sides;
using test::sum_of;

constexpr double kFlux = 24 * std::numbers::pi;  // of the furnace: L_e 1, 24 m^2
constexpr std::size_t kTests = 7;                // of laws, in this file
const double kLevel = test::sidak_level(1e-6, kTests);

TEST(FollowLight, AFurnaceAbsorbsWhatItEmits) {
  const Sides furnace("furnace");
  constexpr std::size_t kPaths = 1 << 20;
  const PathHits hits = follow_light(furnace.world, furnace.sides, furnace.hierarchy, kPaths, 1);
  EXPECT_EQ(hits.escaped, 0);
  // Each path has the same power p and survives with rho = 1/2: it meets n surfaces, P(n) = 2^-n, of mean 2 and variance 2, and
  // each absorbs p / 2. Every one but the first reflects p / 2.
  const double error = kFlux * std::sqrt(0.5 / kPaths);
  EXPECT_GT(test::z_test(hits.absorbed, error, kFlux), kLevel) << hits.absorbed;
  EXPECT_GT(test::z_test(sum_of(hits.reflected), error, kFlux / 2), kLevel) << sum_of(hits.reflected);
  // Roundings of a million floats, each of 2^-24, at worst all one way.
  EXPECT_NEAR(hits.absorbed - sum_of(hits.reflected), kFlux / 2, 1e-6 * kFlux);
  std::uint64_t count = 0;
  for (const std::uint32_t c : hits.count) count += c;
  EXPECT_NEAR(static_cast<double>(count) * kFlux / (2 * kPaths), sum_of(hits.reflected), 1e-5 * kFlux);
}

TEST(FollowLight, EveryPatchOfAFurnaceReflectsTheSame) {
  // Over seeds, since the hits of one path know of each other: E = pi, of which half comes after a reflection.
  const Sides furnace("furnace");
  std::vector<RunningStatistics> density(furnace.hierarchy.nodes.size());
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const PathHits hits = follow_light(furnace.world, furnace.sides, furnace.hierarchy, 1 << 13, seed);
    for (std::size_t i = 0; i < density.size(); ++i) {
      density[i].add(luminance(hits.reflected[i]) / static_cast<double>(furnace.hierarchy.nodes[i].area));
    }
  }
  const std::size_t fronts = furnace.sides.count / 2;
  const double deviations = student_t_quantile(1 - test::sidak_level(kLevel, fronts) / 2, kSeeds - 1);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    const Node& node = furnace.hierarchy.nodes[i];
    if (node.is_cluster() || furnace.hierarchy.patches[node.patch].is_front == 0) {
      EXPECT_EQ(density[i].mean(), 0);  // clusters and the outside
      continue;
    }
    ++lit;
    EXPECT_NEAR(density[i].mean(), std::numbers::pi / 2, deviations * density[i].standard_error());
  }
  EXPECT_EQ(lit, fronts);
}

TEST(FollowLight, CountsHitsAtUndividedPatches) {
  Sides cornell("cornell");
  for (const std::uint32_t leaf : std::vector(cornell.hierarchy.leaves)) subdivide(cornell.hierarchy, leaf);
  const PathHits hits = follow_light(cornell.world, cornell.sides, cornell.hierarchy, 1 << 14, 3);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < hits.count.size(); ++i) {
    if (cornell.hierarchy.nodes[i].child_count > 0) {
      EXPECT_EQ(hits.count[i], 0U);
    }
    EXPECT_TRUE(hits.count[i] > 0 || hits.reflected[i] == SpectrumD());
    count += hits.count[i];
  }
  EXPECT_GT(count, 0U);
}

TEST(FollowLight, WhatIsEmittedIsAbsorbedOrEscapes) {
  // Over seeds: the spread of roulette has no closed form here.
  constexpr int kSeeds = 40;
  for (const char* name : {"cornell", "emitters_reflect", "point_light"}) {
    const Sides scene(name);
    RunningStatistics arrived;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const PathHits hits = follow_light(scene.world, scene.sides, scene.hierarchy, 1 << 12, seed);
      EXPECT_GE(hits.absorbed, 0);
      EXPECT_GE(hits.escaped, 0);
      arrived.add(hits.absorbed + hits.escaped);
    }
    const double deviations = student_t_quantile(1 - kLevel / 2, kSeeds - 1);
    EXPECT_NEAR(arrived.mean(), scene.world.emitters.total_flux, deviations * arrived.standard_error()) << name;
    EXPECT_LT(arrived.standard_error(), 0.01 * arrived.mean()) << name;  // else the test says little
  }
}

TEST(Balance, AFurnaceAbsorbsExactlyWhatLanded) {
  const Sides furnace("furnace");
  PathHits hits = follow_light(furnace.world, furnace.sides, furnace.hierarchy, 1 << 10, 1);
  const double lost = luminance(hits.lost);
  balance(hits);
  // Every hit loses half and reflects half; first ones are not in `reflected`. Roundings of floats.
  EXPECT_NEAR(hits.absorbed, kFlux, 1e-5 * kFlux);
  EXPECT_NEAR(sum_of(hits.reflected), (lost - kFlux / 2) * kFlux / lost, 1e-5 * kFlux);
}

TEST(FollowLight, HasTheSameBitsForAnyNumberOfThreads) {
  const Sides cornell("cornell");
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return follow_light(cornell.world, cornell.sides, cornell.hierarchy, 100'000, 7);  // more than one batch
  };
  const PathHits one = with(1), two = with(2);
  EXPECT_EQ(one.count, two.count);
  EXPECT_EQ(one.reflected, two.reflected);
  EXPECT_EQ(one.absorbed, two.absorbed);
  EXPECT_EQ(one.escaped, two.escaped);
}

TEST(FollowLight, SidesLeftOutKeepNoCount) {
  Sides furnace("furnace");
  std::vector<bool> reachable(furnace.sides.count, true);
  reachable[0] = false;
  furnace.hierarchy = build_hierarchy(furnace.world, furnace.sides, reachable);
  const PathHits hits = follow_light(furnace.world, furnace.sides, furnace.hierarchy, 1 << 16, 1);
  // It reflects as before: a twelfth of the light is not counted, and what is has no more variance than all.
  const double truth = kFlux / 2 * 11 / 12, error = kFlux * std::sqrt(0.5 / (1 << 16));
  EXPECT_GT(test::z_test(sum_of(hits.reflected), error, truth), kLevel) << sum_of(hits.reflected);
  EXPECT_EQ(hits.escaped, 0);
}

}  // namespace
}  // namespace radfarm
