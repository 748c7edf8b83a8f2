#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "estimate/radiance_parts.h"

namespace radfarm {

/// Whether a sample is light: finite and not negative.
inline bool is_light(const RadianceParts& parts) {
  const auto is_light = [](const Spectrum& s) { return is_finite(s) && min_component(s) >= 0; };
  return is_light(parts.emission) && is_light(parts.direct) && is_light(parts.indirect) && is_light(parts.specular);
}

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
    if (!is_light(parts)) {
      ++dropped;
      return;
    }
    const double luminous = luminance(SpectrumD(parts.reflected()));
    emission += SpectrumD(parts.emission);
    direct += SpectrumD(parts.direct);
    indirect += SpectrumD(parts.indirect);
    specular += SpectrumD(parts.specular);
    squared_luminance += luminous * luminous;
    ++samples;
  }
  void add(const PixelSums& more) {
    emission += more.emission;
    direct += more.direct;
    indirect += more.indirect;
    specular += more.specular;
    squared_luminance += more.squared_luminance;
    samples += more.samples;
    dropped += more.dropped;
  }
  SpectrumD reflected() const { return direct + indirect + specular; }
  friend bool operator==(const PixelSums&, const PixelSums&) = default;
};

/// Of the mean reflected luminance of a pixel's n samples: their sample variance over n, NaN of less than two. Samples are
/// stratified, so it is what independent ones would have.
inline double variance_of_mean(const PixelSums& pixel) {
  if (pixel.samples < 2) return std::numeric_limits<double>::quiet_NaN();
  const double n = pixel.samples, mean = luminance(pixel.reflected()) / n;
  return std::max(pixel.squared_luminance / n - mean * mean, 0.0) / (n - 1);
}

/// The same as a number that can be added up: 0 of less than two samples.
inline float noise_of(const PixelSums& pixel) { return pixel.samples < 2 ? 0 : static_cast<float>(variance_of_mean(pixel)); }

}  // namespace radfarm
