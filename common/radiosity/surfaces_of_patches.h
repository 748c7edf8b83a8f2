#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/hierarchy.h"

namespace radfarm {

/// Which near-planar surface each patch belongs to: numbers from 0, in the order of each surface's first patch.
///
/// Sides of one instance that share an edge (its two ends at the same places, whatever their indices) are joined, the flattest edges first,
/// where the surface goes on over the edge, and the sides and the mean normals of what they belong to turn by less than 25 degrees. Edges of more than two
/// triangles, doubled triangles and sides without area are harmless: the last stay by themselves. The order of triangles decides nothing but which of
/// equally flat edges comes first. O(n log n).                                               docs/pipeline.md (radiosity.2b)
std::vector<std::uint32_t> surfaces_of_patches(std::span<const Patch> patches);

}  // namespace radfarm
