#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiosity/hierarchy.h"

namespace radfarm {

/// Irradiance that the emitters give each undivided patch, lux, by next events and rays on the patch itself, combined by
/// the balance heuristic: `min_samples` of each, more on large ones. Links to clusters would spread it over the cluster's lit and shaded
/// patches alike; what a plant sends to the room comes from the leaves that are lit and seen, so who is lit matters. Noise
/// averages out over patches. Unbiased.
/// Values that `direct` already holds (>= 0) are kept; -1 marks those still to do. Keyed by node. About 1 us a sample.
void sample_direct(const World& world, const Hierarchy& hierarchy, std::uint32_t min_samples, std::uint64_t seed,
                   std::vector<Spectrum>& direct, const Progress& progress = {});

/// Two independent estimates of the luminance, lux, that one point of a patch receives: number `index` of those of `key`.
std::array<float, 2> estimate_twice(const World& world, const Patch& patch, std::uint32_t index, std::uint64_t key);

/// A random point of a patch, uniform over its area, with the shading normal that a viewer of its side sees there.
SurfacePoint point_on_patch(const World& world, const Patch& patch, const Vec2& u);

/// The mark of a patch without a value.
inline constexpr Spectrum kNotSampled{-1, -1, -1};

}  // namespace radfarm
