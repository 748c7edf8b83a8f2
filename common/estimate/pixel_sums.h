#pragma once

#include <cstdint>

#include "estimate/radiance_parts.h"

namespace radfarm {

/// Resumable sums of one pixel: adding more samples later continues them. Stored as it is (docs/formats.md).
struct PixelSums {
  SpectrumD emission;
  SpectrumD direct;
  SpectrumD indirect;
  double squared_luminance = 0;  // of reflected light, for the variance of the pixel
  std::uint32_t samples = 0;     // kept in the sums
  std::uint32_t dropped = 0;     // not finite or negative: in no sum, never painted black

  void add(const RadianceParts& parts) {
    const double luminous = luminance(SpectrumD(parts.reflected()));
    const bool is_valid = is_finite(parts.emission) && is_finite(parts.direct) && is_finite(parts.indirect) &&
                          min_component(parts.emission) >= 0 && min_component(parts.direct) >= 0 &&
                          min_component(parts.indirect) >= 0;
    if (!is_valid) {
      ++dropped;
      return;
    }
    emission += SpectrumD(parts.emission);
    direct += SpectrumD(parts.direct);
    indirect += SpectrumD(parts.indirect);
    squared_luminance += luminous * luminous;
    ++samples;
  }
  friend bool operator==(const PixelSums&, const PixelSums&) = default;
};

}  // namespace radfarm
