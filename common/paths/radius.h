#pragma once

#include <span>
#include <vector>

#include "paths/density.h"

namespace radfarm {

/// How wide discs are to be.
struct RadiusRule {
  double crossings = 400;  // that a disc is to count: noise of about 1 / sqrt(crossings)
  float least = 0;         // m
  float most = 0;          // m, > 0
};

/// The radius, m, at which a disc would count as many of `paths` paths as the rule says, by what it counted of
/// `pilot_paths`; `most` where it counted none. docs/pipeline.md (paths.6)
float choose_radius(const Disc& disc, const DiscSums& pilot, double pilot_paths, double paths, const RadiusRule& rule);

/// The radii of discs, one each, by a pilot of one path in 64 more: between `least` (one a disc) and `most`, at which
/// the pilot runs. The same for any number of threads. Requires: emitters. Uses all threads.
std::vector<float> radii_by_pilot(const World& world, const Components& components, std::vector<Disc> discs,
                                  OriginSet origins, const PathBatch& paths, double crossings,
                                  std::span<const float> least, float most);

/// The same of a photon map: at which it has `nearest` photons, by the 12 nearest in a smaller pilot's; m. (map.2)
/// Requires: emitters, nearest > 0. Uses all threads.
std::vector<float> radii_by_nearest(const World& world, std::span<const Disc> discs, OriginSet origins,
                                    const PathBatch& paths, double nearest, std::span<const float> least, float most);

/// How wide discs are where nobody says: the scene's radius times this at most.
inline constexpr float kMostRadius = 1.0F / 50;

}  // namespace radfarm
