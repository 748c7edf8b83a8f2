#pragma once

#include "base/progress.h"
#include "radiosity/hierarchy.h"

namespace radfarm {

/// The tree over all patches: sets which nodes are whose children, the leaves below each, and the leaves' patches; nothing else of a node.
///
/// Near-planar surfaces come first, by surfaces_of_patches(): split_items() goes from all of them down to single ones, then on
/// inside each. So a wall of a thousand triangles is no thousand leaves of the plant before it. O(n log n). Deterministic.
/// Requires: hierarchy.patches are there, one or more; no nodes.
void build_cluster_tree(Hierarchy& hierarchy, const Progress& progress);

}  // namespace radfarm
