#include "scene/height_map.h"

#include <cmath>
#include <cstdint>

#include "math/vec.h"

namespace radfarm {
namespace {

/// The texel beside `at`, `step` (+-1) further, where the texture may end.
std::uint32_t beside(std::uint32_t at, int step, std::uint32_t size, Texture::Wrap wrap) {
  const std::int64_t wanted = std::int64_t{at} + step;
  if (wanted >= 0 && wanted < size) return static_cast<std::uint32_t>(wanted);
  if (wrap == Texture::Wrap::kRepeat) return wanted < 0 ? size - 1 : 0;
  return at;  // clamped or mirrored, the neighbour is the texel itself
}

double height_at(const Texture& heights, std::uint32_t x, std::uint32_t y) {
  const auto& texel = heights.texels[std::size_t{y} * heights.width + x];
  return (0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]) / 255;
}

std::uint8_t stored(double component) { return static_cast<std::uint8_t>(std::lround((component + 1) / 2 * 255)); }

}  // namespace

Texture normal_map_of_heights(const Texture& heights, double scale) {
  Texture normals = heights;
  normals.is_srgb = false;
  for (std::uint32_t y = 0; y < heights.height; ++y) {
    const std::uint32_t above = beside(y, -1, heights.height, heights.wrap_v);
    const std::uint32_t below = beside(y, 1, heights.height, heights.wrap_v);
    for (std::uint32_t x = 0; x < heights.width; ++x) {
      const std::uint32_t left = beside(x, -1, heights.width, heights.wrap_u);
      const std::uint32_t right = beside(x, 1, heights.width, heights.wrap_u);
      const double along = scale * (height_at(heights, right, y) - height_at(heights, left, y)) / 2;
      const double up = scale * (height_at(heights, x, above) - height_at(heights, x, below)) / 2;
      const Vec3d normal = normalize(Vec3d(-along, -up, 1));
      normals.texels[std::size_t{y} * heights.width + x] = {stored(normal.x), stored(normal.y), stored(normal.z), 255};
    }
  }
  return normals;
}

bool looks_like_normal_map(const Texture& image) {
  double red = 0;
  double blue = 0;
  for (const auto& texel : image.texels) red += texel[0], blue += texel[2];
  const auto texels = static_cast<double>(image.texels.size());
  return blue > 180 * texels && blue - red > 60 * texels;
}

}  // namespace radfarm
