#pragma once

#include <cstdint>
#include <vector>

#include "senders/sender_tree.h"

namespace radfarm {

/// Where the receivers of a cut may be: a sphere.
struct ReceiverRegion {
  Vec3 center{0, 0, 0};
  float radius = 0;
};

/// Whether no point of the region can be on the side that any patch of the node faces: it sends nothing there.
bool is_turned_away(const SenderNode& node, const ReceiverRegion& region);

/// A list of senders that covers every leaf of the tree exactly once: from the root, the node whose light at the region
/// varies most is replaced by its children, until the largest variation is below `max_irradiance_change` (lux, luminance)
/// or the list has `max_senders`. Nodes that are turned away are left out: they carry nothing.
/// Ties go to the lower node, so the list depends on its arguments only. O(senders log senders).
std::vector<std::uint32_t> cut_senders(const SenderTree& tree, const ReceiverRegion& region, float max_irradiance_change,
                                       std::uint32_t max_senders);

}  // namespace radfarm
