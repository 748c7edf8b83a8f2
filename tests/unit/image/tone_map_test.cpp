#include "image/tone_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Image grey(std::vector<float> values) {
  Image image;
  image.width = static_cast<int>(values.size());
  image.height = 1;
  image.channels = {{"R", values}, {"G", values}, {"B", values}};
  return image;
}

TEST(AutoExposure, MapsAUniformImageToMiddleGrey) {
  for (const float level : {1e-6F, 0.18F, 5.0F, 1e5F}) {
    const float exposure = auto_exposure(grey(std::vector<float>(100, level)));
    EXPECT_NEAR(level * std::exp2(exposure), 0.18F, 1e-5F);
  }
}

TEST(AutoExposure, BlackPixelsAndEmittersDoNotDecide) {
  std::vector<float> values(100, 0.18F);
  for (std::size_t i = 0; i < 30; ++i) values[i] = 0;
  values[50] = 1e6F;
  values[51] = std::numeric_limits<float>::infinity();
  values[52] = std::numeric_limits<float>::quiet_NaN();
  values[53] = -1;
  EXPECT_NEAR(auto_exposure(grey(values)), 0, 1e-5F);
}

TEST(AutoExposure, BlackImageIsLeftAlone) {
  EXPECT_EQ(auto_exposure(grey({0, 0, 0})), 0);
  EXPECT_EQ(auto_exposure(Image()), 0);
}

TEST(Srgb, CurveHasItsKnownPoints) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_EQ(srgb_from_linear(1), 1);
  EXPECT_EQ(srgb_from_linear(7), 1);
  EXPECT_EQ(srgb_from_linear(-7), 0);
  EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_NEAR(srgb_from_linear(0.18F), 0.4613561F, 1e-6F);
  EXPECT_NEAR(srgb_from_linear(0.0031308F), srgb_from_linear(0.0031309F), 2e-6F);
}

}  // namespace
}  // namespace radfarm
