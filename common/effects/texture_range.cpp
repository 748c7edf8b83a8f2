#include "effects/texture_range.h"

#include <algorithm>
#include <cmath>

#include "math/vec.h"
#include "scene/texture.h"

namespace radfarm {
namespace {

Spectrum distance(const Spectrum& a, const Spectrum& b) {
  return {std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b)};
}

Spectrum larger(const Spectrum& a, const Spectrum& b) {
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}

template <typename Use>
void for_each_texel(const Texture& texture, const Use& use) {
  for (std::uint32_t y = 0; y < texture.height; ++y) {
    for (std::uint32_t x = 0; x < texture.width; ++x) use(texel_at(texture, x, y));
  }
}

}  // namespace

TextureRange range_of(const Texture& texture) {
  TextureRange range;
  SpectrumD sum;
  for_each_texel(texture, [&](const Vec4& t) {
    const Spectrum color(t.x, t.y, t.z);
    sum += SpectrumD(color);
    range.least_alpha = std::min(range.least_alpha, t.w);
    const float mean = luminance(color);
    if (mean > 0) range.color_deviation = std::max(range.color_deviation, max_component(color) / mean - 1);
  });
  range.mean = Spectrum(sum / static_cast<double>(texture.texels.size()));
  for_each_texel(texture, [&](const Vec4& t) {
    range.deviation = larger(range.deviation, distance({t.x, t.y, t.z}, range.mean));
  });
  return range;
}

float largest_angle(const Texture& map, float scale) {
  // The code for 0 is not exact: half a step of 1 / 255 on either axis, and its rounding, is taken as flat.
  constexpr float kStep = 1.0001F / 255;
  float largest = 0;
  for_each_texel(map, [&](const Vec4& t) {
    const auto along = [&](float c) { return std::max(0.0F, std::fabs(2 * c - 1) - kStep) * std::fabs(scale); };
    const float x = along(t.x), y = along(t.y);
    largest = std::max(largest, std::atan2(std::sqrt(x * x + y * y), std::max(0.0F, 2 * t.z - 1)));
  });
  return largest * 180 / kPi;
}

}  // namespace radfarm
