#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/hierarchy.h"

namespace radfarm {

/// E_spec, lux: what specular surfaces whose gloss is not folded send each side of each triangle (SideNumbers), by a few
/// light paths: coarse, as links need it; light paths put it right (radiosity.7). A side with few hits has mostly the mean
/// of its instance's lit sides. Empty where no surface sends light so.    docs/pipeline.md (radiosity.5)
/// Cost: about .3 s of one thread; uses all, the same bits for any number of them.
std::vector<Spectrum> specular_irradiance(const World& world, const SideNumbers& sides, std::uint64_t seed);

/// The same at undivided patches, one a node: parts have that of their triangle's side. Empty where that is.
std::vector<Spectrum> specular_at_patches(std::span<const Spectrum> of_sides, const SideNumbers& sides, const Hierarchy& hierarchy);

}  // namespace radfarm
