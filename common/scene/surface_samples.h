#pragma once

#include <vector>

#include "math/vec.h"
#include "scene/draft_scene.h"
#include "scene/scene.h"

namespace radfarm {

/// Triangles of the world as points that carry their area: all of them up to a few million, else every k-th of each
/// mesh. Enough for where the bulk of a scene is; exact sums are taken elsewhere.
struct SurfaceSamples {
  std::vector<Vec3d> centroids;
  std::vector<double> areas;  // m^2
  double signed_volume = 0;   // m^3, about the median; negative when surfaces mostly face inwards, as in a room

  /// The coordinate along an axis below which lies the fraction q of the area; 0 without area. Cost: O(n log n).
  double quantile(int axis, double q) const;
};

SurfaceSamples sample_surfaces(const DraftScene& draft);
SurfaceSamples sample_surfaces(const Scene& scene);

}  // namespace radfarm
