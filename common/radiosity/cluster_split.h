#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "math/vec.h"

namespace radfarm {

/// One side of a triangle, or a surface of many, on its way into a cluster.
struct ClusterItem {
  Box3 bounds;
  Vec3 centroid;
  Vec3 normal;         // unit; of a surface the mean over its area
  float area = 0;      // m^2
  float diameter = 0;  // longest edge, of a surface the diagonal of its bounds, m
  std::uint32_t number = 0;
};

/// Orders the items so that the first `returned` of them form one cluster and the rest another. Requires: two items or more.
///
/// Items long against the group are split off first, so that a wall never hides in a cluster of leaves. All else is cut where the
/// area-weighted variance in (position, normal) falls most, along the coordinate that varies most: at gaps and folds, so that flat
/// things and fuzzy things part. `depth`: of the group in its tree; beyond a bound the median keeps the tree shallow. O(items).
std::size_t split_items(std::span<ClusterItem> items, int depth);

}  // namespace radfarm
