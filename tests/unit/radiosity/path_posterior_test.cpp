#include "radiosity/path_posterior.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "unit/radiosity/all_sides.h"

namespace radfarm {
namespace {

using test::Sides;
using test::sum_of;

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

TEST(CombineWithGuess, ManyHitsOutweighAWrongGuess) {
  // Guesses off by e^3: their weight is far below a hit each. Where 1000 hits fell they leave less than one part in 100.
  const CutCornell scene(400'000);
  const auto combined = combine_with_guess(scene.hierarchy, scene.hits, random_guess(scene.hierarchy, 1));
  const Totals sums = totals(scene.hierarchy, scene.hits, combined);
  std::size_t many = 0;
  for (std::size_t i = 0; i < sums.count.size(); ++i) {
    if (sums.count[i] < 1000) continue;
    ++many;
    // Black surfaces are hit and reflect nothing: what a guess gives them is a small part of all.
    EXPECT_NEAR(luminance(sums.combined[i]), luminance(sums.found[i]), 0.01 * luminance(sums.found[i]) + 1e-3 * luminance(sums.found[0]));
  }
  EXPECT_GT(many, 20U);
}

TEST(CombineWithGuess, AGuessThatProvesRightOutweighsFewHits) {
  // Many paths are the guess, few the hits: the result must be nearer to the many than the few are, though the
  // sum is that of the few.
  const CutCornell many(4'000'000), few(20'000);
  ASSERT_EQ(many.hierarchy.nodes.size(), few.hierarchy.nodes.size());
  std::vector<Spectrum> guess;
  for (const SpectrumD& power : many.hits.reflected) guess.emplace_back(power);
  const auto combined = combine_with_guess(few.hierarchy, few.hits, guess);
  double off = 0, noise = 0;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    off += std::pow(luminance(SpectrumD(combined[i])) - luminance(SpectrumD(guess[i])), 2);
    noise += std::pow(luminance(few.hits.reflected[i]) - luminance(SpectrumD(guess[i])), 2);
  }
  EXPECT_LT(off, noise);
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

TEST(CombineWithGuess, SharesHitsByThePosteriorMean) {
  for (const auto& counts : {std::array<std::uint32_t, 4>{5, 2, 1, 0}, {10, 6, 4, 0}, {400, 300, 200, 100}}) {
    const FourParts parts(counts);
    const std::array<std::uint32_t, 4> hits = counts;
    GuessTrust trust;
    const Split split = make_split(std::array{0.25, 0.25, 0.25, 0.25}, hits);
    trust.learn(split);
    const double all = hits[0] + hits[1] + hits[2] + hits[3], weight = trust.weight(split);
    const auto power = parts.combined({1, 1, 1, 1});
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(power[i], all * (0.25 * weight + hits[i]) / (weight + all), 1e-5 * all);
    }
  }
}

TEST(CombineWithGuess, WhatIsNeitherExpectedNorHitStaysDark) {
  EXPECT_EQ(FourParts({5, 3, 0, 0}).combined({1, 1, 1, 0})[3], 0);
}

TEST(CombineWithGuess, WhereLinksLeftAllDarkHitsAreBelieved) {
  const auto power = FourParts({5, 3, 2, 0}).combined({0, 0, 0, 0});
  const std::array truth = {5.0, 3.0, 2.0, 0.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(power[i], truth[i], 1e-6);
}

TEST(CombineWithGuess, WithoutHitsThereIsNoLight) {
  const FourParts parts({0, 0, 0, 0});
  for (const double power : parts.combined({1, 2, 3, 4})) EXPECT_EQ(power, 0);
}

/// What splits in two teach whose true share is drawn from a beta distribution of mean `ones` / `k` and weight `k`.
GuessTrust learned(std::uint32_t all, std::uint32_t k, std::uint32_t ones, std::uint64_t seed) {
  GuessTrust trust;
  RandomSequence random(seed);
  const double p = static_cast<double>(ones) / k;
  for (int split = 0; split < 20'000; ++split) {
    // Polya's urn: drawing with one more of the same put back is the beta-binomial distribution.
    std::uint32_t first = 0;
    for (std::uint32_t n = 0; n < all; ++n) first += random.uniform() * static_cast<float>(k + n) < static_cast<float>(ones + first) ? 1 : 0;
    trust.learn(make_split(std::array{p, 1 - p}, std::array{first, all - first}));
  }
  return trust;
}

TEST(GuessTrust, FindsTheWeightWithWhichSharesScatter) {
  // 20,000 splits know their scatter to about 1.5 %, K near N from it to a few times as much; a split that scatters as much agrees.
  for (const std::uint32_t k : {2U, 8U, 32U}) {
    const double likely = 0.5 * (24.0 + k) / (k + 1);
    EXPECT_NEAR(learned(24, k, k / 2, 1).weight({24, likely, 0.5}), k, 0.2 * k) << k;
  }
}

TEST(GuessTrust, ASplitThatContradictsTheGuessIsBelieved) {
  const GuessTrust trust = learned(24, 32, 16, 2);
  const Split even = make_split(std::array{0.5, 0.5}, std::array{12U, 12U}), odd = make_split(std::array{0.5, 0.5}, std::array{24U, 0U});
  EXPECT_GT(trust.weight(even), 32);
  EXPECT_LT(trust.weight(odd), 2);
}

TEST(GuessTrust, ABinomialProvesTheGuess) {
  GuessTrust trust;
  RandomSequence random(3);
  for (int split = 0; split < 20'000; ++split) {
    std::uint32_t first = 0;
    for (int n = 0; n < 24; ++n) first += random.uniform() < 0.3F ? 1 : 0;
    trust.learn(make_split(std::array{0.3, 0.7}, std::array{first, 24 - first}));
  }
  // The scatter is 1 +- .015 of the least: K is above 24 / (4 x .015), but for a chance below 1e-4.
  EXPECT_GT(trust.weight({24, 0.42, 0.42}), 400);
}

TEST(GuessTrust, WithoutEvidenceItIsOneHit) {
  for (const std::uint64_t hits : {2U, 1000U, 4'000'000'000U}) {
    const double likely = 0.5 * (static_cast<double>(hits) + 1) / 2;
    EXPECT_NEAR(GuessTrust().weight({hits, likely, 0.5}), 1, 1e-6);
  }
}

}  // namespace
}  // namespace radfarm
