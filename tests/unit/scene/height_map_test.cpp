#include "scene/height_map.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

using Texel = std::array<std::uint8_t, 4>;

/// A grey image of 4 x 4, its brightness by column or by row.
Texture ramp(const std::array<std::uint8_t, 4>& grey, bool by_row) {
  Texture image;
  image.width = image.height = 4;
  image.wrap_u = image.wrap_v = Texture::Wrap::kClamp;
  for (std::size_t i = 0; i < 16; ++i) {
    const std::uint8_t g = grey[by_row ? i / 4 : i % 4];
    image.texels.push_back({g, g, g, 255});
  }
  return image;
}

Vec3 normal_at(const Texture& normals, std::size_t x, std::size_t y) {
  const Texel& texel = normals.texels[y * normals.width + x];
  return Vec3(texel[0], texel[1], texel[2]) * (2 / 255.0F) - Vec3(1, 1, 1);
}

TEST(HeightMap, AFlatOneGivesNormalsStraightUp) {
  const Texture normals = normal_map_of_heights(ramp({80, 80, 80, 80}, false), 5);
  EXPECT_FALSE(normals.is_srgb);
  for (const Texel& texel : normals.texels) EXPECT_EQ(texel, (Texel{128, 128, 255, 255}));
}

TEST(HeightMap, NormalsLeanAwayFromTheRise) {
  // Rises by 51/255 = 0.2 a texel to the right, five texels high: a slope of 1.
  const Vec3 right = normal_at(normal_map_of_heights(ramp({0, 51, 102, 153}, false), 5), 1, 2);
  EXPECT_NEAR(right.x, -0.7071, 0.01);
  EXPECT_NEAR(right.y, 0, 0.01);
  // Rises towards the bottom row, so the normal leans up in the image, where green is.
  const Vec3 down = normal_at(normal_map_of_heights(ramp({0, 51, 102, 153}, true), 5), 1, 2);
  EXPECT_NEAR(down.x, 0, 0.01);
  EXPECT_NEAR(down.y, 0.7071, 0.01);
}

TEST(HeightMap, BordersFollowTheWrapMode) {
  Texture image = ramp({0, 51, 51, 0}, false);
  EXPECT_NEAR(normal_at(normal_map_of_heights(image, 5), 3, 0).x, 0.447, 0.01);  // half of the slope 1, alone
  image.wrap_u = Texture::Wrap::kRepeat;
  EXPECT_NEAR(normal_at(normal_map_of_heights(image, 5), 3, 0).x, 0.447, 0.01);  // column 0 is as high as column 3
  image = ramp({51, 0, 0, 0}, false);
  image.wrap_u = Texture::Wrap::kRepeat;
  EXPECT_LT(normal_at(normal_map_of_heights(image, 5), 3, 0).x, -0.4);  // column 0 rises beyond the border
}

TEST(HeightMap, NormalMapsAreToldFromHeights) {
  EXPECT_TRUE(looks_like_normal_map(normal_map_of_heights(ramp({0, 20, 40, 90}, false), 2)));
  EXPECT_FALSE(looks_like_normal_map(ramp({255, 255, 255, 255}, false)));
}

}  // namespace
}  // namespace radfarm
