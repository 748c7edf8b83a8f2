#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vec.h"
#include "scene/footprint.h"
#include "scene/scene.h"

namespace radfarm {

/// A texture at half, a quarter ... of its size, down to one texel: each texel the mean, in linear light, of what it covers.
/// [Williams 1983, Pyramidal parametrics]. 16-bit linear: two thirds of the texture's memory on top of it.
struct TexturePyramid {
  struct Level {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint16_t, 4>> texels;
  };
  std::vector<Level> levels;  // the first is half the texture's size, rounded down; empty for 1 x 1

  std::size_t bytes() const;
};

/// What a texel's colour counts by in the means: a cut-out's where it covers, so that what its holes are painted with stays out.
enum class ColorWeight : std::uint8_t { kEven, kAlpha };

/// Sizes that are not even are shared out by area, so every level has the texture's mean. O(texels), in parallel.
TexturePyramid make_pyramid(const Texture& texture, ColorWeight weight);

/// The texture's mean over the footprint about uv: (r, g, b, alpha). A footprint up to a texel wide is texture_lookup(); else
/// as many look-ups as it is longer than wide, at most 16, of the two levels between whose texels its width lies. A longer one is
/// cut: the pixel's samples cover the rest, where widening it would blur.
Vec4 filtered_lookup(const Texture& texture, const TexturePyramid& pyramid, const Vec2& uv, const UvFootprint& footprint);

}  // namespace radfarm
