#include "radiosity/oracles.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

// Samples are floats: a few roundings of 6e-8 each.
constexpr double kFloat = 1e-6;

constexpr Oracle kAll[] = {Oracle::kKs, Oracle::kKl, Oracle::kCs, Oracle::kHe, Oracle::kVar};
constexpr Oracle kDivergences[] = {Oracle::kKl, Oracle::kCs, Oracle::kHe};

double divergence(Oracle oracle, std::span<const float> samples) {
  return oracle == Oracle::kKl   ? kl_divergence(samples)
         : oracle == Oracle::kCs ? chi_square_divergence(samples)
                                 : hellinger_divergence(samples);
}

/// Ten kernels as links meet them: some lines are blocked.
std::vector<float> random_kernels(RandomSequence& random) {
  std::vector<float> samples;
  for (int i = 0; i < 10; ++i) samples.push_back(random.uniform() < 0.3F ? 0.0F : random.uniform());
  return samples;
}

double mean(const std::vector<float>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

struct Golden {
  std::vector<float> samples;
  double kl, cs, he;
};

std::vector<Golden> golden_vectors() {  // ALGORITHMS 1.2.4
  std::vector<float> ramp;
  for (int i = 1; i <= 8; ++i) ramp.push_back(static_cast<float>(i) / 8);
  return {{ramp, 0.142643671, 0.259259259, 0.0391597045},
          {{1, 0, 0, 0, 0, 0, 0, 0}, 2.0794415, 7, 0.6464466},
          {{1, 1, 1, 1, 0, 0, 0, 0}, 0.6931472, 1, 0.2928932}};
}

TEST(Oracles, AgreeWithTheGoldenVectors) {
  for (const Golden& g : golden_vectors()) {
    EXPECT_NEAR(kl_divergence(g.samples), g.kl, 5e-8);  // the printed digits
    EXPECT_NEAR(chi_square_divergence(g.samples), g.cs, 5e-10);
    EXPECT_NEAR(hellinger_divergence(g.samples), g.he, 5e-8);
  }
}

TEST(Oracles, OneBrightSampleHasItsClosedForm) {  // H43
  for (const std::size_t n : {2U, 8U, 10U, 64U}) {
    std::vector<float> samples(n, 0.0F);
    samples[n / 2] = 1e10F;
    const auto count = static_cast<double>(n);
    EXPECT_NEAR(kl_divergence(samples), std::log(count), 1e-12);
    EXPECT_NEAR(chi_square_divergence(samples), count - 1, 1e-12 * count);
    EXPECT_NEAR(hellinger_divergence(samples), 1 - 1 / std::sqrt(count), 1e-12);
  }
}

TEST(Oracles, AreZeroForAConstantKernelOrNone) {  // H41, H42
  for (const Oracle oracle : kAll) {
    for (const float value : {0.0F, 1.0F, 0.3F, 1e-30F, 1e30F}) {
      EXPECT_EQ(misplaced_kernel(oracle, std::vector<float>(8, value)), 0) << value;
    }
    EXPECT_EQ(misplaced_kernel(oracle, {}), 0);
    EXPECT_EQ(literal_kernel(oracle, {}, 1), 0);
    EXPECT_EQ(literal_kernel(oracle, std::vector<float>(8, 0.0F), 1), 0);
  }
}

TEST(Oracles, LoseNoDigitsNearAConstant) {  // H44, with the smallest steps that floats hold
  // Half 1 + e, half 1 - e: chi^2 = e^2, D = e^2 / 2, h^2 = e^2 / 8, each to a factor 1 + O(e^2).
  const float center = 0x1p23F;
  for (const float step : {1.0F, 2.0F, 64.0F}) {
    const std::vector<float> samples = {center + step, center - step, center + step, center - step};
    const double e = static_cast<double>(step) / static_cast<double>(center);
    EXPECT_NEAR(kl_divergence(samples) / (e * e / 2), 1, kFloat) << step;
    EXPECT_NEAR(chi_square_divergence(samples) / (e * e), 1, kFloat) << step;
    EXPECT_NEAR(hellinger_divergence(samples) / (e * e / 8), 1, kFloat) << step;
  }
}

TEST(Oracles, AreOneUnitNearAConstant) {
  // sigma^2 / (2 mean) of all three divergences; sigma of VAR; step of KS.
  const std::vector<float> samples = {1.001F, 0.999F, 1.001F, 0.999F};
  const double e = 0.001;
  for (const Oracle oracle : kDivergences) EXPECT_NEAR(misplaced_kernel(oracle, samples) / (e * e / 2), 1, 1e-3);
  EXPECT_NEAR(misplaced_kernel(Oracle::kVar, samples) / e, 1, 1e-3);
  EXPECT_NEAR(misplaced_kernel(Oracle::kKs, samples) / e, 1, 1e-3);
}

TEST(Oracles, ScaleWithTheKernelWhateverItsSize) {  // H45
  RandomSequence random(1);
  for (int run = 0; run < 100; ++run) {
    const std::vector<float> samples = random_kernels(random);
    for (const int exponent : {-100, -20, 40, 120}) {  // exact, without denormals: samples hold 24 bits below 1
      std::vector<float> scaled(samples.rbegin(), samples.rend());
      for (float& f : scaled) f = std::ldexp(f, exponent);
      for (const Oracle oracle : kAll) {
        const double expected = std::ldexp(misplaced_kernel(oracle, samples), exponent);
        EXPECT_NEAR(misplaced_kernel(oracle, scaled), expected, 1e-12 * expected);
      }
    }
  }
  const std::vector<float> denormal = {0x1p-149F, 0x1p-148F}, same = {1, 2};
  for (const Oracle oracle : kDivergences) EXPECT_NEAR(divergence(oracle, denormal), divergence(oracle, same), 1e-12);
}

TEST(Oracles, WhatIsNoKernelCountsAsNone) {  // H46, H48
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> clean = {1, 2, 0, 0};
  for (const float bad : {kNan, kInfinity, -kInfinity, -1.0F, -0.0F}) {
    for (const Oracle oracle : kAll) {
      EXPECT_EQ(misplaced_kernel(oracle, std::vector<float>{1, 2, bad, 0}), misplaced_kernel(oracle, clean)) << bad;
      EXPECT_EQ(literal_kernel(oracle, std::vector<float>{1, 2, bad, 0}, 1), literal_kernel(oracle, clean, 1)) << bad;
    }
  }
}

TEST(Oracles, DivergencesKeepTheirOrderAndBoundWhatIsMisplaced) {
  RandomSequence random(2);
  for (int run = 0; run < 1000; ++run) {
    const std::vector<float> samples = random_kernels(random);
    const double kl = kl_divergence(samples), chi_square = chi_square_divergence(samples);
    const double hellinger = hellinger_divergence(samples);
    EXPECT_GE(hellinger, 0);
    EXPECT_LE(2 * hellinger, kl + 1e-12);
    EXPECT_LE(kl, std::log1p(chi_square) + 1e-12);
    EXPECT_LE(kl, std::log(10.0) + 1e-12);
    if (!(mean(samples) > 0)) continue;
    double astray = 0;  // the share of light that a constant kernel sends to the wrong place
    for (const float f : samples) astray += std::fabs(static_cast<double>(f) / mean(samples) - 1) / 20;
    EXPECT_LE(astray, std::sqrt(kl / 2) + 1e-12);  // Pinsker
    EXPECT_LE(astray, std::sqrt(chi_square) / 2 + 1e-12);
    EXPECT_LE(astray, std::sqrt(2 * hellinger) + 1e-12);
    EXPECT_LE(astray * mean(samples), misplaced_kernel(Oracle::kKs, samples) + 1e-12);
  }
}

TEST(Oracles, LiteralFormsAreTheStableOnesTimesKnownFactors) {  // eq. 21 to 24 and 3, samples far from constant
  RandomSequence random(3);
  for (int run = 0; run < 1000; ++run) {
    const std::vector<float> samples = random_kernels(random);
    const double sigma = misplaced_kernel(Oracle::kVar, samples), area = 0.25;
    EXPECT_NEAR(literal_kernel(Oracle::kKl, samples, area), 10 * misplaced_kernel(Oracle::kKl, samples), 1e-12);
    EXPECT_NEAR(literal_kernel(Oracle::kCs, samples, area), 20 * misplaced_kernel(Oracle::kCs, samples), 1e-12);
    EXPECT_NEAR(literal_kernel(Oracle::kHe, samples, area), 2.5 * misplaced_kernel(Oracle::kHe, samples), 1e-12);
    EXPECT_NEAR(literal_kernel(Oracle::kVar, samples, area), sigma * sigma, 1e-12);
    EXPECT_NEAR(literal_kernel(Oracle::kKs, samples, area), misplaced_kernel(Oracle::kKs, samples) / area, 1e-12);
  }
}

}  // namespace
}  // namespace radfarm
