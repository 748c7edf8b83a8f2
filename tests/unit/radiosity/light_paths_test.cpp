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
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kFlux = 24 * std::numbers::pi;  // of the furnace: L_e 1, 24 m^2
constexpr std::size_t kTests = 7;                // of laws, in this file
const double kLevel = test::sidak_level(1e-6, kTests);

/// A scene with all its sides in a hierarchy.
struct Sides {
  explicit Sides(const std::string& name)
      : world(test::own_scene(name)),
        sides(world.scene),
        hierarchy(build_hierarchy(world, sides, std::vector<bool>(sides.count, true))) {}

  World world;
  SideNumbers sides;
  Hierarchy hierarchy;
};

double sum_of(const std::vector<SpectrumD>& values) {
  double sum = 0;
  for (const SpectrumD& value : values) sum += luminance(value);
  return sum;
}

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

/// Random power over the undivided patches, in proportion to their area times a factor of e^-3 to e^3 in each channel.
std::vector<Spectrum> random_guess(const Hierarchy& hierarchy, std::uint64_t seed) {
  RandomSequence random(seed);
  const auto factor = [&] { return std::exp(6 * random.uniform() - 3); };
  std::vector<Spectrum> guess(hierarchy.nodes.size());
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    const Spectrum colour(factor(), factor(), factor());
    if (!node.is_cluster() && node.child_count == 0) guess[i] = colour * node.area;
  }
  return guess;
}

struct Totals {
  std::vector<std::uint32_t> count;
  std::vector<SpectrumD> found;
  std::vector<SpectrumD> combined;
};

Totals totals(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& combined) {
  Totals sums{hits.count, hits.reflected, {}};
  for (const Spectrum& power : combined) sums.combined.emplace_back(power);
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) {
    const std::uint32_t parent = hierarchy.nodes[i].parent;
    sums.count[parent] += sums.count[i];
    sums.found[parent] += sums.found[i];
    sums.combined[parent] += sums.combined[i];
  }
  return sums;
}

void expect_same_power(const SpectrumD& a, const SpectrumD& b) {
  // Every patch's power is rounded to a float once.
  EXPECT_NEAR(a.r, b.r, 1e-6 * b.r);
  EXPECT_NEAR(a.g, b.g, 1e-6 * b.g);
  EXPECT_NEAR(a.b, b.b, 1e-6 * b.b);
}

/// Cornell's sides cut into parts twice, hit by few paths.
struct CutCornell : Sides {
  explicit CutCornell(std::size_t paths) : Sides("cornell") {
    for (int level = 0; level < 2; ++level) {
      const auto count = static_cast<std::uint32_t>(hierarchy.nodes.size());
      for (std::uint32_t i = 0; i < count; ++i) {
        if (!hierarchy.nodes[i].is_cluster() && hierarchy.nodes[i].child_count == 0) subdivide(hierarchy, i);
      }
    }
    hits = follow_light(world, sides, hierarchy, paths, 5);
  }
  PathHits hits;
};

TEST(CombineWithGuess, KeepsThePowerFoundWhateverTheGuess) {
  for (const std::size_t paths : {4U, 300U, 20'000U}) {
    const CutCornell scene(paths);
    ASSERT_GT(sum_of(scene.hits.reflected), 0);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      std::vector<Spectrum> guess = random_guess(scene.hierarchy, seed);
      if (seed == 3) guess.assign(guess.size(), Spectrum());  // dark
      const auto combined = combine_with_guess(scene.hierarchy, scene.hits, guess);
      const Totals sums = totals(scene.hierarchy, scene.hits, combined);
      expect_same_power(sums.combined[0], sums.found[0]);
      for (const Spectrum& power : combined) EXPECT_GE(min_component(power), 0);
    }
  }
}

TEST(CombineWithGuess, NodesWithEnoughHitsKeepExactlyTheirPower) {
  const CutCornell scene(20'000);
  const auto combined = combine_with_guess(scene.hierarchy, scene.hits, random_guess(scene.hierarchy, 1));
  const Totals sums = totals(scene.hierarchy, scene.hits, combined);
  std::size_t enough = 0, few = 0;
  for (std::size_t i = 0; i < sums.count.size(); ++i) {
    sums.count[i] >= 16 ? ++enough : ++few;
    if (sums.count[i] >= 16) expect_same_power(sums.combined[i], sums.found[i]);
  }
  EXPECT_GT(enough, 100U);
  EXPECT_GT(few, 100U);
}

/// One triangle in four parts under a root, and what paths found there: `counts` hits of 1 lm each.
struct FourParts {
  explicit FourParts(const std::array<std::uint32_t, 4>& counts) {
    test::SceneMaker maker;
    maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const World world(maker.take());
    const SideNumbers sides(world.scene);
    hierarchy = build_hierarchy(world, sides, {true, false});
    first = subdivide(hierarchy, hierarchy.leaves[0]);
    hits = {std::vector<std::uint32_t>(hierarchy.nodes.size()), std::vector<SpectrumD>(hierarchy.nodes.size())};
    for (std::uint32_t i = 0; i < 4; ++i) {
      hits.count[first + i] = counts[i];
      hits.reflected[first + i] = SpectrumD(static_cast<double>(counts[i]));
    }
  }
  /// Power of the parts when the guess shares it as `guess`.
  std::array<double, 4> combined(const std::array<float, 4>& guess) const {
    std::vector<Spectrum> power(hierarchy.nodes.size());
    for (std::uint32_t i = 0; i < 4; ++i) power[first + i] = Spectrum(guess[i]);
    power = combine_with_guess(hierarchy, hits, power);
    return {power[first].g, power[first + 1].g, power[first + 2].g, power[first + 3].g};
  }
  Hierarchy hierarchy;
  std::uint32_t first = 0;
  PathHits hits;
};

TEST(CombineWithGuess, SharesFewHitsByThePosteriorMean) {
  // An even guess: m = 2 hits expected of each, and (n + 1) / (m + 1) of it given.
  const FourParts parts({5, 2, 1, 0});
  const auto power = parts.combined({1, 1, 1, 1});
  const std::array truth = {4.0, 2.0, 4.0 / 3, 2.0 / 3};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(power[i], truth[i], 1e-6);
}

TEST(CombineWithGuess, SharesTheHitsOfAWholeByThePosteriorMeanToo) {
  // 20 hits: the whole keeps its power, and shares it; none of the parts has enough hits for itself. m = 5.
  const FourParts parts({10, 6, 4, 0});
  const auto power = parts.combined({1, 1, 1, 1});
  const std::array truth = {20 * 11 / 24.0, 20 * 7 / 24.0, 20 * 5 / 24.0, 20 * 1 / 24.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(power[i], truth[i], 1e-5);
}

TEST(CombineWithGuess, WhatIsNeitherExpectedNorHitStaysNearlyDark) {
  // Only the even share of the guess reaches it: 5 % of 8 lm over 4 parts, of which it keeps 1 / (0.1 + 1).
  const FourParts parts({5, 3, 0, 0});
  const auto power = parts.combined({1, 1, 1, 0});
  EXPECT_GE(power[3], 0);
  EXPECT_LT(power[3], 0.05 * 8 / 4);
}

TEST(CombineWithGuess, WithoutHitsThereIsNoLight) {
  const FourParts parts({0, 0, 0, 0});
  for (const double power : parts.combined({1, 2, 3, 4})) EXPECT_EQ(power, 0);
}

}  // namespace
}  // namespace radfarm
