#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/vec.h"
#include "scene/scene.h"

namespace radfarm {

/// The texture at uv, bilinearly filtered in linear light: (r, g, b, alpha). About 20 ns.
Vec4 texture_lookup(const Texture& texture, const Vec2& uv);

/// One texel, linear. Requires: x < width, y < height.
Vec4 texel_at(const Texture& texture, std::uint32_t x, std::uint32_t y);

/// The texel that stands where a row of `size` texels, repeated or not, has its i-th.
std::uint32_t wrap(std::int64_t i, std::uint32_t size, Texture::Wrap mode);

/// Of `fetch(x, y)`, the texels of an image of this size, the bilinear mean at uv.
template <typename Fetch>
Vec4 bilinear(std::uint32_t width, std::uint32_t height, Texture::Wrap wrap_u, Texture::Wrap wrap_v, const Vec2& uv,
              const Fetch& fetch) {
  // Coordinates beyond 2^20 repeats have no fraction left in a float: any texel is as right as another.
  const float limit = 1 << 20;
  const float x = std::clamp(uv.x, -limit, limit) * static_cast<float>(width) - 0.5F;
  const float y = std::clamp(uv.y, -limit, limit) * static_cast<float>(height) - 0.5F;
  const float x_floor = std::floor(x), y_floor = std::floor(y);
  const auto column = static_cast<std::int64_t>(x_floor), row = static_cast<std::int64_t>(y_floor);
  const std::uint32_t x0 = wrap(column, width, wrap_u), x1 = wrap(column + 1, width, wrap_u);
  const std::uint32_t y0 = wrap(row, height, wrap_v), y1 = wrap(row + 1, height, wrap_v);
  const float fx = x - x_floor, fy = y - y_floor;
  const Vec4 top = fetch(x0, y0) * (1 - fx) + fetch(x1, y0) * fx;
  const Vec4 bottom = fetch(x0, y1) * (1 - fx) + fetch(x1, y1) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace radfarm
