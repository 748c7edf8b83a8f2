#include "scene/texture.h"

#include <array>
#include <cmath>

namespace radfarm {
namespace {

// IEC 61966-2-1, the exact curve: every 8-bit code's linear value.
std::array<float, 256> make_linear_of_srgb() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double code = static_cast<double>(i) / 255.0;
    table[i] = static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
  }
  return table;
}

std::uint32_t wrap(std::int64_t i, std::uint32_t size, Texture::Wrap mode) {
  const auto n = static_cast<std::int64_t>(size);
  if (mode == Texture::Wrap::kClamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
  const std::int64_t period = mode == Texture::Wrap::kMirror ? 2 * n : n;
  std::int64_t k = i % period;
  if (k < 0) k += period;
  return static_cast<std::uint32_t>(k < n ? k : period - 1 - k);
}

Vec4 texel(const Texture& texture, std::int64_t x, std::int64_t y) {
  return texel_at(texture, wrap(x, texture.width, texture.wrap_u), wrap(y, texture.height, texture.wrap_v));
}

}  // namespace

Vec4 texel_at(const Texture& texture, std::uint32_t x, std::uint32_t y) {
  static const std::array<float, 256> linear_of_srgb = make_linear_of_srgb();
  const auto& code = texture.texels[std::size_t{y} * texture.width + x];
  const float alpha = static_cast<float>(code[3]) / 255.0F;
  if (texture.is_srgb) return {linear_of_srgb[code[0]], linear_of_srgb[code[1]], linear_of_srgb[code[2]], alpha};
  return {static_cast<float>(code[0]) / 255.0F, static_cast<float>(code[1]) / 255.0F,
          static_cast<float>(code[2]) / 255.0F, alpha};
}

Vec4 texture_lookup(const Texture& texture, const Vec2& uv) {
  // Coordinates beyond 2^20 repeats have no fraction left in a float: any texel is as right as another.
  const float limit = 1 << 20;
  const float x = std::clamp(uv.x, -limit, limit) * static_cast<float>(texture.width) - 0.5F;
  const float y = std::clamp(uv.y, -limit, limit) * static_cast<float>(texture.height) - 0.5F;
  const float x_floor = std::floor(x), y_floor = std::floor(y);
  const auto x0 = static_cast<std::int64_t>(x_floor), y0 = static_cast<std::int64_t>(y_floor);
  const float fx = x - x_floor, fy = y - y_floor;
  const Vec4 top = texel(texture, x0, y0) * (1 - fx) + texel(texture, x0 + 1, y0) * fx;
  const Vec4 bottom = texel(texture, x0, y0 + 1) * (1 - fx) + texel(texture, x0 + 1, y0 + 1) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace radfarm
