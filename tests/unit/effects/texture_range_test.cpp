#include "effects/texture_range.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Texture texture_of(bool is_srgb, std::vector<std::array<std::uint8_t, 4>> texels) {
  Texture texture;
  texture.width = static_cast<std::uint32_t>(texels.size());
  texture.height = 1;
  texture.is_srgb = is_srgb;
  texture.texels = std::move(texels);
  return texture;
}

TEST(TextureRange, OfOneColourIsThatColour) {
  const TextureRange range = range_of(texture_of(false, {{51, 51, 51, 255}, {51, 51, 51, 255}}));
  EXPECT_NEAR(range.mean.g, 0.2F, 1e-6F);
  EXPECT_LT(max_component(range.deviation), 1e-6F);
  EXPECT_LT(range.color_deviation, 1e-6F);
  EXPECT_EQ(range.least_alpha, 1);
}

TEST(TextureRange, SpansItsTexelsChannelByChannel) {
  const TextureRange range = range_of(texture_of(false, {{0, 102, 255, 255}, {255, 102, 255, 51}}));
  EXPECT_NEAR(range.mean.r, 0.5F, 1e-6F);
  EXPECT_NEAR(range.deviation.r, 0.5F, 1e-6F);
  EXPECT_NEAR(range.deviation.g, 0, 1e-6F);
  EXPECT_NEAR(range.deviation.b, 0, 1e-6F);
  EXPECT_NEAR(range.least_alpha, 0.2F, 1e-6F);
  // The first texel: luminance 0.7152 x 0.4 + 0.0722, and blue 1.
  EXPECT_NEAR(range.color_deviation, 1 / (0.7152F * 0.4F + 0.0722F) - 1, 1e-4F);
}

TEST(TextureRange, IsOfLinearLight) {
  // sRGB code 188 is half the light, to a code's step.
  EXPECT_NEAR(range_of(texture_of(true, {{188, 188, 188, 255}})).mean.g, 0.5F, 0.005F);
  EXPECT_NEAR(range_of(texture_of(true, {{0, 0, 0, 255}, {255, 255, 255, 255}})).mean.g, 0.5F, 1e-6F);
}

TEST(LargestAngle, OfAFlatMapIsZero) {
  // 0 has no exact code: 127 and 128 are as near.
  EXPECT_EQ(largest_angle(texture_of(false, {{128, 128, 255, 255}, {127, 127, 255, 255}}), 1), 0);
  EXPECT_EQ(largest_angle(texture_of(false, {{255, 128, 255, 255}}), 0), 0) << "scale 0 flattens any map";
}

TEST(LargestAngle, IsThatOfTheSteepestTexel) {
  // (1, 0, 1) is 45 degrees; half a step of 1/255 is taken off.
  const Texture map = texture_of(false, {{128, 128, 255, 255}, {255, 128, 255, 255}, {160, 128, 255, 255}});
  EXPECT_NEAR(largest_angle(map, 1), 45, 0.2);
  EXPECT_NEAR(largest_angle(map, -1), 45, 0.2);
  EXPECT_NEAR(largest_angle(map, 0.5F), 26.565, 0.2);
  EXPECT_NEAR(largest_angle(texture_of(false, {{128, 0, 128, 255}}), 1), 90, 0.4);
}

}  // namespace
}  // namespace radfarm
