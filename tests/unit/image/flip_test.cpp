#include "image/flip.h"

#include <cmath>

#include <gtest/gtest.h>

#include "math/spectrum.h"

namespace radfarm {
namespace {

Image flat(int width, int height, const Spectrum& color) {
  Image image;
  image.width = width, image.height = height;
  const auto n = static_cast<std::size_t>(width * height);
  image.channels["R"] = std::vector<float>(n, color.r);
  image.channels["G"] = std::vector<float>(n, color.g);
  image.channels["B"] = std::vector<float>(n, color.b);
  return image;
}

TEST(Flip, IsNothingBetweenEqualImagesAndOneBetweenBlackAndWhite) {
  const Image black = flat(16, 9, Spectrum(0.0F)), white = flat(16, 9, Spectrum(1.0F));
  EXPECT_EQ(flip(white, white, 0)->mean, 0);
  // HyAB of black and white is 100, of green and blue, which sets the scale, 308 [paper, section 3.1]: in the upper part.
  const FlipMap map = *flip(black, white, 0);
  EXPECT_GT(map.mean, 0.95);
  EXPECT_LT(map.mean, 1);
  for (const float value : map.values) EXPECT_NEAR(value, map.mean, 1e-5);
  EXPECT_NEAR(flip(flat(8, 8, {0, 1, 0}), flat(8, 8, {0, 0, 1}), 0)->mean, 1, 1e-4);
}

TEST(Flip, IsSymmetricAndSeesWhatTheDisplayShows) {
  const Image a = flat(16, 16, {.2F, .3F, .4F}), b = flat(16, 16, {.25F, .3F, .35F});
  EXPECT_NEAR(flip(a, b, 0)->mean, flip(b, a, 0)->mean, 1e-6);
  EXPECT_EQ(flip(flat(8, 8, Spectrum(2.0F)), flat(8, 8, Spectrum(9.0F)), 0)->mean, 0) << "both are white";
  EXPECT_GT(flip(flat(8, 8, Spectrum(2.0F)), flat(8, 8, Spectrum(9.0F)), -4)->mean, 0.1);
}

/// One bright pixel in grey.
Image spot(float value) {
  Image image = flat(31, 31, Spectrum(.2F));
  for (const char* c : {"R", "G", "B"}) image.channels[c][15 * 31 + 15] = value;
  return image;
}

TEST(Flip, BlursWhatIsTooFineAndStrengthensPoints) {
  const Image grey = flat(31, 31, Spectrum(.2F));
  const FlipMap faint = *flip(spot(.3F), grey, 0), bright = *flip(spot(1), grey, 0);
  EXPECT_GT(bright.values[15 * 31 + 15], faint.values[15 * 31 + 15]);
  EXPECT_GT(faint.values[15 * 31 + 15], faint.values[15 * 31 + 19]);
  EXPECT_GT(faint.values[15 * 31 + 16], 0) << "the eye blurs over pixels";
  EXPECT_NEAR(faint.values[0], 0, 1e-3);
  // From farther away a pixel is less.
  EXPECT_LT(flip(spot(1), grey, 0, 200)->values[15 * 31 + 15], bright.values[15 * 31 + 15]);
}

TEST(Flip, RefusesImagesOfOtherSizes) {
  const Result<FlipMap> map = flip(flat(4, 4, Spectrum(1.0F)), flat(5, 4, Spectrum(1.0F)), 0);
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
