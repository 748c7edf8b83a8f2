#include "scene/texture_pyramid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "scene/texture.h"

namespace radfarm {
namespace {

// Levels are coded to 16 bits: half a step, and the roundings of a mean's floats.
constexpr float kCode = 0.5F / 65535 + 64 * 0x1p-24F;

Texture noise(std::uint32_t width, std::uint32_t height, bool is_srgb) {
  Texture texture{width, height, is_srgb, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {}};
  RandomSequence random(width * 1000 + height);
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const std::uint64_t bits = random.bits();
    texture.texels.push_back({static_cast<std::uint8_t>(bits & 255), static_cast<std::uint8_t>(bits >> 8 & 255),
                              static_cast<std::uint8_t>(bits >> 16 & 255), static_cast<std::uint8_t>(bits >> 24 & 255)});
  }
  return texture;
}

Vec4 mean_of(const Texture& texture) {
  Vec4 sum(0, 0, 0, 0);
  for (std::uint32_t y = 0; y < texture.height; ++y) {
    for (std::uint32_t x = 0; x < texture.width; ++x) sum += texel_at(texture, x, y);
  }
  return sum / static_cast<float>(texture.texels.size());
}

Vec4 mean_of(const TexturePyramid::Level& level) {
  Vec4 sum(0, 0, 0, 0);
  for (const auto& code : level.texels) sum += Vec4(code[0], code[1], code[2], code[3]) / 65535;
  return sum / static_cast<float>(level.texels.size());
}

void expect_near(const Vec4& a, const Vec4& b, float tolerance) {
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << k;
}

UvFootprint square(float width) { return {{width, 0}, {0, width}}; }

TEST(TexturePyramid, EveryLevelHasTheMeanOfTheTexture) {
  for (const auto& [width, height] : {std::pair{64U, 64U}, {63U, 31U}, {7U, 1U}, {1U, 5U}, {100U, 3U}}) {
    for (const bool is_srgb : {false, true}) {
      const Texture texture = noise(width, height, is_srgb);
      const TexturePyramid pyramid = make_pyramid(texture, ColorWeight::kEven);
      ASSERT_FALSE(pyramid.levels.empty());
      for (const auto& level : pyramid.levels) expect_near(mean_of(level), mean_of(texture), kCode);
      EXPECT_EQ(pyramid.levels.back().texels.size(), 1U);
    }
  }
}

TEST(TexturePyramid, HalvesAndRoundsDown) {
  const TexturePyramid pyramid = make_pyramid(noise(13, 4, true), ColorWeight::kEven);
  ASSERT_EQ(pyramid.levels.size(), 3U);
  EXPECT_EQ(pyramid.levels[0].width, 6U);
  EXPECT_EQ(pyramid.levels[0].height, 2U);
  EXPECT_EQ(pyramid.levels[2].width, 1U);
  EXPECT_EQ(pyramid.levels[2].height, 1U);
  EXPECT_TRUE(make_pyramid(noise(1, 1, true), ColorWeight::kEven).levels.empty());
}

TEST(TexturePyramid, TakesAtMostTwoThirdsOfTheTexture) {
  const Texture texture = noise(256, 128, true);
  EXPECT_LT(static_cast<double>(make_pyramid(texture, ColorWeight::kEven).bytes()),
            2.0 / 3 * static_cast<double>(texture.texels.size() * sizeof(texture.texels[0])) + 8);
}

TEST(TexturePyramid, HolesDoNotColourWhatIsAround) {
  // Half of the texels are holes painted blue: the mean of what covers is red, and half is covered.
  Texture texture{2, 2, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat,
                  {{255, 0, 0, 255}, {0, 0, 255, 0}, {0, 0, 255, 0}, {255, 0, 0, 255}}};
  const auto top_of = [&] { return make_pyramid(texture, ColorWeight::kAlpha).levels.back().texels[0]; };
  const std::array<std::uint16_t, 4> top = top_of();
  const auto part = [&](std::size_t k) { return static_cast<float>(top[k]) / 65535; };
  const float blue = 1.0F / 4096;  // what a hole still counts, so that a texture of holes has a mean
  EXPECT_NEAR(part(0), 1, blue + kCode);
  EXPECT_NEAR(part(2), 0, blue + kCode);
  EXPECT_NEAR(part(3), 0.5F, kCode);
  for (auto& texel : texture.texels) texel = {0, 0, 255, 0};
  const std::array<std::uint16_t, 4> holes = top_of();
  EXPECT_EQ(holes[2], 65535);
  EXPECT_EQ(holes[3], 0);
}

TEST(FilteredLookup, UpToATexelIsThePlainLookUp) {
  const Texture texture = noise(64, 64, true);
  const TexturePyramid pyramid = make_pyramid(texture, ColorWeight::kEven);
  for (const float texels : {0.0F, 0.5F, 1.0F}) {
    EXPECT_EQ(filtered_lookup(texture, pyramid, {0.3F, 0.7F}, square(texels / 64)), texture_lookup(texture, {0.3F, 0.7F}));
  }
}

TEST(FilteredLookup, AFootprintOfTheWholeTextureIsItsMean) {
  for (const auto& [width, height] : {std::pair{64U, 64U}, {63U, 31U}}) {
    const Texture texture = noise(width, height, true);
    const TexturePyramid pyramid = make_pyramid(texture, ColorWeight::kEven);
    expect_near(filtered_lookup(texture, pyramid, {0.3F, 0.7F}, square(64)), mean_of(texture), 2 * kCode);
  }
}

TEST(FilteredLookup, FourTimesTheWidthIsTwoLevels) {
  // At a texel's centre on its level, a look-up of just that level is the texel.
  const Texture texture = noise(64, 64, true);
  const TexturePyramid pyramid = make_pyramid(texture, ColorWeight::kEven);
  for (const std::size_t level : {1U, 3U}) {
    const auto& coarse = pyramid.levels[level - 1];
    const float size = static_cast<float>(coarse.width);
    const auto& code = coarse.texels[std::size_t{1} * coarse.width + 2];
    const float width = static_cast<float>(1U << level) / 64;
    expect_near(filtered_lookup(texture, pyramid, {2.5F / size, 1.5F / size}, square(width)),
                Vec4(code[0], code[1], code[2], code[3]) / 65535, kCode);
  }
}

TEST(FilteredLookup, ALongFootprintStaysSharpAcross) {
  // Columns of black and white: along them nothing is lost, across them all.
  Texture stripes{16, 16, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {}};
  for (int i = 0; i < 256; ++i) {
    const std::uint8_t code = i % 2 == 0 ? 255 : 0;
    stripes.texels.push_back({code, code, code, 255});
  }
  const TexturePyramid pyramid = make_pyramid(stripes, ColorWeight::kEven);
  const Vec2 white{0.5F / 16, 0.5F / 16};
  const float texel = 1.0F / 16;
  EXPECT_NEAR(filtered_lookup(stripes, pyramid, white, {{0, 8 * texel}, {texel, 0}}).x, 1, kCode);
  EXPECT_NEAR(filtered_lookup(stripes, pyramid, white, {{texel, 0}, {0, 8 * texel}}).x, 1, kCode) << "either order";
  EXPECT_NEAR(filtered_lookup(stripes, pyramid, white, {{8 * texel, 0}, {0, texel}}).x, 0.5F, kCode);
}

TEST(FilteredLookup, KeepsToTheWrapMode) {
  // Black at the left, white at the right: beyond the right edge a clamped texture is white, a repeated one begins again.
  Texture texture{4, 1, false, Texture::Wrap::kClamp, Texture::Wrap::kClamp,
                  {{0, 0, 0, 255}, {0, 0, 0, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}}};
  const auto beyond = [&] {
    return filtered_lookup(texture, make_pyramid(texture, ColorWeight::kEven), {1.25F, 0.5F}, {{0.5F, 0}, {0, 2}}).x;
  };
  EXPECT_NEAR(beyond(), 1, kCode);
  texture.wrap_u = Texture::Wrap::kMirror;
  EXPECT_NEAR(beyond(), 1, kCode);
  texture.wrap_u = Texture::Wrap::kRepeat;
  EXPECT_NEAR(beyond(), 0, kCode);
}

TEST(FilteredLookup, AnOverflowingFootprintIsTheMean) {
  const Texture texture = noise(8, 8, true);
  const TexturePyramid pyramid = make_pyramid(texture, ColorWeight::kEven);
  expect_near(filtered_lookup(texture, pyramid, {0.5F, 0.5F}, square(3e38F)), mean_of(texture), 2 * kCode);
}

}  // namespace
}  // namespace radfarm
