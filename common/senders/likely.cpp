#include "senders/likely.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMaxChildren = 4;

}  // namespace

SenderOutline outline_of(const SenderTree& tree, std::uint32_t id) {
  const SenderNode& node = tree.nodes[id];
  const Vec3 normal = node.patch == kNone ? Vec3(0, 0, 0) : tree.patches[node.patch].normal;
  const Vec3 half = node.bounds.size() * 0.5F;
  return {node.bounds.center(), half, length(half), node.area, normal, node.power};
}

float likely_irradiance(const SenderOutline& sender, const Vec3& position, const Vec3& normal) {
  const Vec3 offset = sender.center - position;
  const float distance = std::max(length(offset), sender.radius);
  if (!(distance > 0)) return 0;
  // Some point of the sphere stands this high above the receiver's horizon.
  const float cosine_x = std::min(1.0F, (dot(normal, offset) + sender.radius) / distance);
  if (!(cosine_x > 0)) return 0;
  const auto beyond = [](float to_center, float half) { return std::max(0.0F, std::fabs(to_center) - half); };
  const Vec3 gap(beyond(offset.x, sender.half.x), beyond(offset.y, sender.half.y), beyond(offset.z, sender.half.z));
  const float nearest = length(gap);
  float cosine_y = 1;
  if (sender.normal != Vec3(0, 0, 0)) {
    const float height = -dot(sender.normal, offset);
    if (!(height + 1e-4F * sender.radius > 0)) return 0;  // behind the plane of the patch
    cosine_y = nearest > height ? std::max(height / nearest, 0.02F) : 1;
  }
  // However near, a sender of even radiosity gives no more than P / A.
  const float reach = std::max(nearest * nearest, std::min(sender.radius * sender.radius, sender.area / kPi));
  return sender.power * cosine_x * cosine_y / (kPi * reach);
}

DrawnPatch draw_patch(const SenderTree& tree, std::uint32_t id, const Vec3& position, const Vec3& normal, float choice) {
  float probability = 1;
  while (tree.nodes[id].patch == kNone) {
    const SenderNode& node = tree.nodes[id];
    RADFARM_DCHECK(node.child_count <= kMaxChildren);
    std::array<float, kMaxChildren> likely{};
    float total = 0;
    for (std::uint32_t i = 0; i < node.child_count; ++i) {
      total += likely[i] = likely_irradiance(outline_of(tree, node.first_child + i), position, normal);
    }
    if (!(total > 0)) return {id, 0};
    float left = choice * total;
    std::uint32_t chosen = 0;
    while (chosen + 1 < node.child_count && (left >= likely[chosen] || likely[chosen] == 0)) left -= likely[chosen++];
    if (likely[chosen] == 0) return {id, 0};  // rounding at the very end of the last share
    choice = std::clamp(left / likely[chosen], 0.0F, 0x1.fffffep-1F);
    probability *= likely[chosen] / total;
    id = node.first_child + chosen;
  }
  return {id, probability};
}

}  // namespace radfarm
