#include "image/reference_error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr int kSide = 64;

/// A flat image with noise of its own seed, under so much emission.
Image noisy(float level, float spread, std::uint64_t seed, float emission = 0) {
  Image image;
  image.width = image.height = kSide;
  std::vector<float> values, emitted(kSide * kSide, emission);
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    RandomSequence random(combine(seed, i));
    values.push_back(emission + level + spread * (random.uniform() - .5F) * std::sqrt(12.0F));
  }
  for (const char* c : {"R", "G", "B"}) image.channels[c] = values, image.channels[std::string("emission.") + c] = emitted;
  return image;
}

TEST(ReferenceError, IsFreeOfTheReferencesNoise) {
  const Image a = noisy(1, .3F, 1), b = noisy(1, .3F, 2);
  const ReferenceError exact = reference_error(noisy(1, 0, 3), a, b).value();
  EXPECT_LT(exact.relative_low, 1e-3);
  EXPECT_LT(exact.relative, .05) << "where one reference would have shown .3";
  EXPECT_NEAR(exact.reference_relative, .3 / std::sqrt(2.0), .01);
  const ReferenceError off = reference_error(noisy(1.1F, .2F, 3), a, b).value();
  const double truth = std::sqrt(.1 * .1 + .2 * .2);
  EXPECT_GT(off.relative_high, truth);
  EXPECT_LT(off.relative_low, truth);
  EXPECT_NEAR(off.relative, truth, .02);
  EXPECT_NEAR(off.ratio_of_means, 1.1, .02);
}

TEST(ReferenceError, LooksAtWhatIsReflected) {
  const Image a = noisy(1, 0, 1), b = noisy(1, 0, 2);
  EXPECT_NEAR(reference_error(noisy(1, 0, 3, 100), a, b).value().relative, 0, 1e-4);
}

TEST(ReferenceError, CountsOnlyWhatIsFinite) {
  Image image = noisy(1, 0, 1);
  image.channels["R"][5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(reference_error(image, noisy(1, 0, 1), noisy(1, 0, 2)).value().mse, 0);
  image.width = 32;
  EXPECT_EQ(reference_error(image, noisy(1, 0, 1), noisy(1, 0, 2)).error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
