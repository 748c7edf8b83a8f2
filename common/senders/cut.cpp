#include "senders/cut.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

struct Candidate {
  float change = 0;  // of irradiance over the region, lux
  std::uint32_t node = 0;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.change != b.change ? a.change < b.change : a.node > b.node;
  }
};

/// How much the node's unoccluded irradiance may differ from what its centre alone would give: P / (pi d^2) times the
/// angle it subtends, at most all of it.
float irradiance_change(const SenderNode& node, const ReceiverRegion& region) {
  const float radius = length(node.bounds.size()) / 2;
  const float to_center = length(node.bounds.center() - region.center);
  const float distance = std::max(to_center - region.radius / 2, radius / 2);
  if (!(distance > 0)) return 0;  // a point sender at the region's very centre: nothing is left to divide
  return node.power / (kPi * distance * distance) * std::min(1.0F, 2 * radius / distance);
}

}  // namespace

bool is_turned_away(const SenderNode& node, const ReceiverRegion& region) {
  if (node.cone_cosine <= -1) return false;
  const Vec3 offset = region.center - node.bounds.center();
  const float distance = length(offset);
  const float radii = length(node.bounds.size()) / 2 + region.radius;
  if (!(distance > radii)) return false;
  const float angle = std::acos(std::clamp(dot(node.cone_axis, offset) / distance, -1.0F, 1.0F));
  return angle - std::acos(node.cone_cosine) - std::asin(radii / distance) > kPi / 2;
}

std::vector<std::uint32_t> cut_senders(const SenderTree& tree, const ReceiverRegion& region, float max_irradiance_change,
                                       std::uint32_t max_senders) {
  std::vector<std::uint32_t> final_nodes;
  std::vector<Candidate> heap;
  const auto push = [&](std::uint32_t id) {
    const SenderNode& node = tree.nodes[id];
    if (is_turned_away(node, region)) return;
    const float change = irradiance_change(node, region);
    if (node.child_count == 0 || change <= max_irradiance_change) {
      final_nodes.push_back(id);
      return;
    }
    heap.push_back({change, id});
    std::push_heap(heap.begin(), heap.end());
  };
  if (!tree.nodes.empty()) push(0);
  while (!heap.empty() && heap.size() + final_nodes.size() < max_senders) {
    std::pop_heap(heap.begin(), heap.end());
    const SenderNode& node = tree.nodes[heap.back().node];
    heap.pop_back();
    for (std::uint32_t i = 0; i < node.child_count; ++i) push(node.first_child + i);
  }
  for (const Candidate& candidate : heap) final_nodes.push_back(candidate.node);
  std::sort(final_nodes.begin(), final_nodes.end());
  return final_nodes;
}

}  // namespace radfarm
