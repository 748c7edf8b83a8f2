#include "image/visibility_threshold.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

// The golden values are given to four digits.
constexpr double kDigits = 6e-4;

TEST(VisibleDifference, HasTheValuesOfTheFit) {
  const double golden[][2] = {{1e-5, 1.380e-3}, {1e-3, 1.840e-3}, {.01, 5.472e-3}, {.1, .04027},
                              {1, .39130},      {10, 1.07190},    {100, 5.55904},  {1e3, 55.590}};
  for (const auto& [luminance, difference] : golden) {
    EXPECT_NEAR(visible_difference(luminance) / difference, 1, kDigits) << luminance;
  }
  EXPECT_EQ(visible_difference(0), visible_difference(1e-5));
  EXPECT_EQ(visible_difference(-1), visible_difference(1e-5));
}

TEST(VisibleDifference, NeverFallsAndHasNoSteps) {
  double before = visible_difference(1e-6);
  for (double l = -6; l < 6; l += 1e-4) {
    const double now = visible_difference(std::pow(10, l));
    EXPECT_GE(now, before) << l;
    EXPECT_LT(now, before * 1.001) << l;  // the steepest part grows by 10^(1e-4)
    before = now;
  }
}

TEST(ContrastSensitivity, HasTheValuesOfTheFit) {
  const double golden[][2] = {{.25, 104.3}, {1, 327.9}, {3.248, 525.15}, {4, 514.2}, {8, 334.4}, {16, 124.9}, {32, 16.8}};
  for (const auto& [frequency, sensitivity] : golden) {
    EXPECT_NEAR(contrast_sensitivity(frequency, 100) / sensitivity, 1, 4e-3) << frequency;
  }
}

TEST(ContrastSensitivity, IsFiniteAtAnyFrequencyAndLuminance) {
  for (const double frequency : {0.0, 1e-30, 60.0, 1e30, std::numeric_limits<double>::infinity()}) {
    for (const double luminance : {0.0, 1e-30, 1e30}) {
      const double s = contrast_sensitivity(frequency, luminance);
      EXPECT_TRUE(std::isfinite(s) && s > 0) << frequency << " " << luminance;
    }
  }
  EXPECT_LT(contrast_sensitivity(1e30, 100), 1);
}

TEST(MaskingBy, HasTheValuesOfTheFormula) {
  const double golden[][2] = {{0, 1}, {.1, 1.0004}, {.5, 1.0341}, {1, 1.1892}, {2, 1.6799}, {10, 5.0139}};
  for (const auto& [contrast, elevation] : golden) EXPECT_NEAR(masking_by(contrast), elevation, 1e-4) << contrast;
  EXPECT_EQ(masking_by(-2), masking_by(2));
}

LuminanceImage image_of(int width, int height, const std::function<double(int, int)>& at) {
  LuminanceImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.values.push_back(static_cast<float>(at(x, y)));
  }
  return image;
}

constexpr double kDensity = 16;  // pixels per degree

TEST(JudgeVisibility, FindsNothingWhereAllIsEven) {
  for (const double value : {0.0, 1e-9, 18.0, 1e9}) {
    const Visibility even = judge_visibility(image_of(40, 30, [&](int, int) { return value; }), kDensity, 10);
    for (const float e : even.elevation.values) EXPECT_EQ(e, 1) << value;
    for (const float a : even.adaptation.values) EXPECT_NEAR(static_cast<double>(a), value, 1e-6 * value);
  }
}

TEST(JudgeVisibility, FindsDetailWhereItIsAndNotInShading) {
  // Left a checkerboard of two pixels, 4 cycles a degree; right an even slope.
  const LuminanceImage image = image_of(256, 64, [](int x, int y) {
    return x < 128 ? ((x / 2 + y / 2) % 2 == 0 ? 30.0 : 10.0) : 20.0 + 0.05 * (x - 128);
  });
  const Visibility found = judge_visibility(image, kDensity, 10);
  const auto at = [&](std::size_t x) { return found.elevation.values[32 * 256 + x]; };
  EXPECT_GT(at(64), 5);
  EXPECT_LT(at(200), 1.5F);
}

TEST(JudgeVisibility, StaysWithinItsBoundsWhateverTheImage) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  RandomSequence random(1);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 70), std::pair(33, 17)}) {
    for (const double density : {1e-6, 16.0, 1e9}) {
      const LuminanceImage image = image_of(width, height, [&](int x, int) {
        if (x == 3) return static_cast<double>(infinity);
        return x == 5 ? static_cast<double>(nan) : std::exp(40 * random.uniform_double() - 20);
      });
      for (const float most : {1.0F, 4.0F}) {
        const Visibility found = judge_visibility(image, density, most);
        ASSERT_EQ(found.elevation.values.size(), image.values.size());
        for (const float e : found.elevation.values) EXPECT_TRUE(e >= 1 && e <= most) << e;
        for (const float a : found.adaptation.values) EXPECT_TRUE(std::isfinite(a) && a >= 0) << a;
      }
    }
  }
}

TEST(Displayed, IsWhiteAtMost) {
  const LuminanceImage shown = displayed({2, 1, {0.1F, 5}}, 1);
  EXPECT_FLOAT_EQ(shown.values[0], 20);
  EXPECT_FLOAT_EQ(shown.values[1], 100);
}

}  // namespace
}  // namespace radfarm
