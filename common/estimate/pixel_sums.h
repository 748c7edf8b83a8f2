#pragma once

#include <cstdint>

#include "estimate/radiance_parts.h"

namespace radfarm {

/// Resumable sums of one pixel: adding more samples later continues them. Stored as it is (docs/formats.md).
struct PixelSums {
  SpectrumD emission;
  SpectrumD direct;
  SpectrumD indirect;
  SpectrumD specular;
  double squared_luminance = 0;  // of reflected light, for the variance of the pixel
  std::uint32_t samples = 0;     // kept in the sums
  std::uint32_t dropped = 0;     // not finite or negative: in no sum, never painted black

  void add(const RadianceParts& parts) {
    const double luminous = luminance(SpectrumD(parts.reflected()));
    const auto is_light = [](const Spectrum& s) { return is_finite(s) && min_component(s) >= 0; };
    const bool is_valid = is_light(parts.emission) && is_light(parts.direct) && is_light(parts.indirect) &&
                          is_light(parts.specular);
    if (!is_valid) {
      ++dropped;
      return;
    }
    emission += SpectrumD(parts.emission);
    direct += SpectrumD(parts.direct);
    indirect += SpectrumD(parts.indirect);
    specular += SpectrumD(parts.specular);
    squared_luminance += luminous * luminous;
    ++samples;
  }
  SpectrumD reflected() const { return direct + indirect + specular; }
  friend bool operator==(const PixelSums&, const PixelSums&) = default;
};

}  // namespace radfarm
