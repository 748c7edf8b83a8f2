#include "image/color_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::array<std::array<float, 3>, 10> kViridis = {{{68, 1, 84},
                                                            {72, 40, 120},
                                                            {62, 74, 137},
                                                            {49, 104, 142},
                                                            {38, 130, 142},
                                                            {31, 158, 137},
                                                            {53, 183, 121},
                                                            {109, 205, 89},
                                                            {180, 222, 44},
                                                            {253, 231, 37}}};

constexpr double kTail = 0.01;  // of the values, at each end

float value_at(std::vector<float>& values, double quantile) {
  const auto rank = std::lround(quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

Rgba8 viridis(float t) {
  if (std::isnan(t)) return kNotANumber;
  const float at = std::clamp(t, 0.0F, 1.0F) * (kViridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  const float rest = at - static_cast<float>(below);
  Rgba8 color{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = static_cast<std::uint8_t>(std::lround((1 - rest) * kViridis[below][c] + rest * kViridis[below + 1][c]));
  }
  return color;
}

Rgba8 color_of_id(float id) {
  if (std::isnan(id)) return kNotANumber;
  if (id < 0) return {0, 0, 0, 255};
  const std::uint64_t bits = mix64(static_cast<std::uint64_t>(id) + 1);
  // Never so dark that it could be nothing.
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>(64 + ((bits >> shift) & 0xffU) * 191 / 255); };
  return {channel(0), channel(8), channel(16), 255};
}

ValueRange robust_range(std::span<const float> values) {
  std::vector<float> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](float v) { return std::isfinite(v); });
  if (finite.empty()) return {};
  const float low = value_at(finite, kTail);
  return {low, value_at(finite, 1 - kTail)};
}

}  // namespace radfarm
