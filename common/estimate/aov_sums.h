#pragma once

#include <array>
#include <cstdint>

#include "estimate/counters.h"
#include "estimate/first_surface.h"

namespace radfarm {

/// Resumable sums of one pixel's AOVs, beside its PixelSums. Stored as it is (docs/formats.md); no padding.
struct AovSums {
  SpectrumD albedo;                    // over the samples that PixelSums keeps; what sees nothing adds 0
  Vec3d normal{0, 0, 0};
  SpectrumD irradiance;                // over `hits`
  double depth = 0;                    // over `hits`, m along the view axis
  double threshold = 0;                // over `hits`, cd/m^2: of the grid's vertex
  std::array<double, 4> classes{};     // over `classified`: the share of a vertex's senders that are interpolated, resampled in
                                       // form factor, in visibility, in both
  std::uint64_t camera_rays = 0;       // of all samples, dropped ones too
  std::uint64_t visibility_rays = 0;
  std::uint64_t form_factor_samples = 0;
  std::uint32_t hits = 0;              // samples that saw a surface
  std::uint32_t classified = 0;        // of these, on a vertex that has senders
  std::uint32_t cell = kNone;          // of the grid, of the first sample that saw a surface
  std::uint32_t vertex = kNone;

  /// What one sample cost: the counters before and after it.
  void add_cost(const Counters& before, const Counters& after);
  /// What a kept sample saw. `seen_depth` in m along the view axis.
  void add(const FirstSurface& seen, float seen_depth);
  friend bool operator==(const AovSums&, const AovSums&) = default;
};
static_assert(sizeof(AovSums) == 15 * sizeof(double) + 3 * sizeof(std::uint64_t) + 4 * sizeof(std::uint32_t),
              "AovSums has padding");

}  // namespace radfarm
