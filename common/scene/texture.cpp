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

}  // namespace

Vec4 texel_at(const Texture& texture, std::uint32_t x, std::uint32_t y) {
  static const std::array<float, 256> linear_of_srgb = make_linear_of_srgb();
  const auto& code = texture.texels[std::size_t{y} * texture.width + x];
  const float alpha = static_cast<float>(code[3]) / 255.0F;
  if (texture.is_srgb) return {linear_of_srgb[code[0]], linear_of_srgb[code[1]], linear_of_srgb[code[2]], alpha};
  return {static_cast<float>(code[0]) / 255.0F, static_cast<float>(code[1]) / 255.0F,
          static_cast<float>(code[2]) / 255.0F, alpha};
}

std::uint32_t wrap(std::int64_t i, std::uint32_t size, Texture::Wrap mode) {
  const auto n = static_cast<std::int64_t>(size);
  if (i >= 0 && i < n) return static_cast<std::uint32_t>(i);
  if (mode == Texture::Wrap::kClamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
  const std::int64_t period = mode == Texture::Wrap::kMirror ? 2 * n : n;
  const bool is_power_of_two = (period & (period - 1)) == 0;
  std::int64_t k = is_power_of_two ? i & (period - 1) : i % period;  // a division costs as much as the rest of a look-up
  if (k < 0) k += period;
  return static_cast<std::uint32_t>(k < n ? k : period - 1 - k);
}

Vec4 texture_lookup(const Texture& texture, const Vec2& uv) {
  return bilinear(texture.width, texture.height, texture.wrap_u, texture.wrap_v, uv,
                  [&](std::uint32_t x, std::uint32_t y) { return texel_at(texture, x, y); });
}

}  // namespace radfarm
