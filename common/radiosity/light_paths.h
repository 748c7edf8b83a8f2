#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/hierarchy.h"

namespace radfarm {

/// What paths of light met, after their first surface: light that emitters give directly is in sample_direct().
struct PathHits {
  std::vector<std::uint32_t> count;    // one a node, at undivided patches
  std::vector<SpectrumD> reflected;    // lm, one a node, at undivided patches: what they reflect of it
  double absorbed = 0;                 // luminance, lm; at first surfaces too
  double escaped = 0;
};

/// Follows `paths` paths of light from the emitters until they are absorbed or leave the scene.  docs/pipeline.md (radiosity.7)
///
/// Paths go on from the very points they meet, with the reflectance there, so nothing is smeared over patches; they survive a
/// reflection with the share of luminance that is reflected. A side that was left out of the hierarchy reflects like any other
/// but keeps no count. About 1 us a ray. Deterministic for any thread count.
PathHits follow_light(const World& world, const SideNumbers& sides, const Hierarchy& hierarchy, std::size_t paths,
                      std::uint64_t seed);

/// The power that undivided patches reflect of light that other surfaces sent, from what paths found and, where those were
/// few, from `guess` (one a node, lm): a patch that expected m hits by the guess and got n is given (n + 1) / (m + 1) of it,
/// the posterior mean if the guess's error has an exponential distribution. Nodes with 16 hits and more keep exactly the power
/// that the paths brought. O(nodes).
std::vector<Spectrum> combine_with_guess(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& guess);

}  // namespace radfarm
