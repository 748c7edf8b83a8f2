#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiosity/hierarchy.h"

namespace radfarm {

/// What paths of light met, after their first surface: what emitters bring there is known already.
struct PathHits {
  std::vector<std::uint32_t> count;    // one a node, at undivided patches
  std::vector<SpectrumD> reflected;    // lm, one a node, at undivided patches: what they reflect of it
  double absorbed = 0;                 // luminance, lm; at first surfaces too
  double escaped = 0;
  SpectrumD landed{};                  // lm: what first surfaces received ...
  SpectrumD lost{};                    // ... and what was absorbed or escaped from there on; of the same mean
};

/// Follows `paths` paths of light until they are absorbed or leave the scene.                 docs/pipeline.md (radiosity.7)
///
/// They go on from the very points they meet, with the reflectance there, so nothing is smeared over patches, and where gloss is not
/// folded by their lobes; they survive with the share of luminance that is sent on. A side that was left out of the hierarchy
/// reflects like any other but keeps no count. About 1 us a ray. Deterministic for any thread count.
PathHits follow_light(const World& world, const SideNumbers& sides, const Hierarchy& hierarchy, std::size_t paths,
                      std::uint64_t seed, const Progress& progress = {});

/// Scales what was found, by channel, so that as much is lost as had landed. What chance did to the length
/// of paths is mostly taken out: of one reflectance rho everywhere and nowhere to escape, all but 1 - rho of it. Its bias is of order 1 / paths.
void balance(PathHits& hits);

}  // namespace radfarm
