#include "radiosity/oracles.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

// Samples are floats: a few roundings of 6e-8 each.
constexpr double kFloat = 1e-6;

TEST(KlDivergence, AgreesWithTheGoldenVectors) {  // ALGORITHMS 1.2.4
  std::vector<float> ramp;
  for (int i = 1; i <= 8; ++i) ramp.push_back(static_cast<float>(i) / 8);
  EXPECT_NEAR(kl_divergence(ramp), 0.142643671, 1e-9);
  const std::vector<float> one_hot = {1, 0, 0, 0, 0, 0, 0, 0}, half = {1, 1, 1, 1, 0, 0, 0, 0};
  EXPECT_NEAR(kl_divergence(one_hot), std::log(8.0), 1e-14);
  EXPECT_NEAR(kl_divergence(half), std::log(2.0), 1e-14);
}

TEST(KlDivergence, IsZeroForAConstantKernelOrNone) {
  for (const float value : {0.0F, 1.0F, 0.3F, 1e-30F, 1e30F}) {
    EXPECT_EQ(kl_divergence(std::vector<float>(8, value)), 0) << value;
  }
  EXPECT_EQ(kl_divergence({}), 0);
}

TEST(KlDivergence, LosesNoDigitsNearAConstant) {
  // Half 1 + e, half 1 - e: D = e^2 / 2 + O(e^4); the literal formula gives rounding noise of 1e-17 already at e = 1e-8.
  // The smallest e that floats hold around 2^24 is 1 part in 2^24.
  const float center = 0x1p23F;
  for (const float step : {1.0F, 2.0F, 64.0F}) {
    const std::vector<float> samples = {center + step, center - step, center + step, center - step};
    const double e = static_cast<double>(step) / static_cast<double>(center);
    EXPECT_NEAR(kl_divergence(samples) / (e * e / 2), 1, kFloat) << step;
  }
}

TEST(KlDivergence, DoesNotDependOnScaleOrOrderAndIsNeverNegative) {
  RandomSequence random(1);
  for (int run = 0; run < 200; ++run) {
    std::vector<float> samples, scaled;
    for (int i = 0; i < 10; ++i) samples.push_back(random.uniform() < 0.3F ? 0.0F : random.uniform());
    for (std::size_t i = samples.size(); i-- > 0;) scaled.push_back(samples[i] * 1024);
    const double divergence = kl_divergence(samples);
    EXPECT_GE(divergence, 0);
    EXPECT_LE(divergence, std::log(10.0) + 1e-12);
    EXPECT_NEAR(kl_divergence(scaled), divergence, 1e-14);
  }
}

}  // namespace
}  // namespace radfarm
