#pragma once

#include <cstdint>

#include "estimate/first_surface.h"
#include "estimate/radiance_parts.h"

namespace radfarm {

/// What sharing light among pixels needs of one beside its PixelSums (sharing/share_light.h). Its samples are drawn in two halves
/// that share no random number: those of odd and of even index. Resumable, stored as it is (docs/formats.md); no padding.
struct SharingSums {
  SpectrumD direct, indirect;   // of the kept samples of odd index
  SpectrumD albedo;             // over all kept samples; what sees nothing adds 0
  Vec3d normal{0, 0, 0};        // over `hits`
  Vec3d position{0, 0, 0};      // over `hits`, m
  std::uint32_t samples = 0;    // of odd index, kept
  std::uint32_t hits = 0;       // kept samples that saw a surface

  /// What a kept sample saw and found.
  void add(bool is_odd, const RadianceParts& parts, const FirstSurface& seen) {
    if (is_odd) {
      direct += SpectrumD(parts.direct);
      indirect += SpectrumD(parts.indirect);
      ++samples;
    }
    if (!seen.is_seen) return;
    albedo += SpectrumD(seen.albedo);
    normal += to_double(seen.normal);
    position += to_double(seen.position);
    ++hits;
  }
  friend bool operator==(const SharingSums&, const SharingSums&) = default;
};
static_assert(sizeof(SharingSums) == 15 * sizeof(double) + 2 * sizeof(std::uint32_t), "SharingSums has padding");

}  // namespace radfarm
