#include "senders/likely.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMaxChildren = 4;
// The likely irradiance is this share of the bound at least.
constexpr float kBoundShare = 0.1F;

}  // namespace

SenderOutline outline_of(const SenderTree& tree, std::uint32_t id) {
  const SenderNode& node = tree.nodes[id];
  SenderOutline outline;
  outline.center = node.bounds.center();
  outline.half = node.bounds.size() * 0.5F;
  outline.radius = length(outline.half);
  outline.max_radiosity = node.max_radiosity;
  outline.power = node.power;
  outline.emits = is_black(node.emitted_power) ? 0 : 1;
  if (node.patch != kNone) {
    outline.normal = tree.patches[node.patch].normal;
    outline.plane = dot(outline.normal, tree.patches[node.patch].vertices[0]);
  }
  return outline;
}

Vec3 gap_to_box(const Vec3& offset, const Vec3& half) {
  const auto beyond = [](float along, float extent) { return std::max(0.0F, std::fabs(along) - extent); };
  return {beyond(offset.x, half.x), beyond(offset.y, half.y), beyond(offset.z, half.z)};
}

JudgedIrradiance judge_irradiance(const SenderOutline& sender, const Vec3& position, const Vec3& normal, float near_distance) {
  const Vec3 offset = sender.center - position;
  const float to_center = length(offset), distance = std::max(to_center, sender.radius);
  if (sender.emits == 0 && to_center + sender.radius < near_distance) return {};
  if (!(distance > 0)) return {};
  // The box's highest point above the receiver's horizon.
  const float highest = dot(normal, offset) + std::fabs(normal.x) * sender.half.x + std::fabs(normal.y) * sender.half.y +
                        std::fabs(normal.z) * sender.half.z;
  if (!(highest > 0)) return {};
  const float nearest = length(gap_to_box(offset, sender.half));
  const float cosine_x = nearest > highest ? highest / nearest : 1;
  float cosine_y = 1;
  if (sender.normal != Vec3(0, 0, 0)) {
    const float height = dot(sender.normal, position) - sender.plane;
    if (!(height > 0)) return {};  // behind the plane of the patch
    cosine_y = nearest > height ? height / nearest : 1;
  }
  // However near, a sender gives no more than its largest radiosity.
  const float counted = sender.emits != 0 ? nearest : std::max(nearest, near_distance);
  const float squared = kPi * counted * counted;
  const float bound = squared * sender.max_radiosity > sender.power ? sender.power / squared : sender.max_radiosity;
  // At most the bound: the centre of a sender that sticks out beyond `near_distance` may be nearer than that.
  const float typical = std::min(bound, sender.power / (kPi * distance * distance));
  const float cosines = cosine_x * cosine_y;
  return {(kBoundShare * bound + (1 - kBoundShare) * typical) * cosines, bound * cosines};
}

DrawnPatch draw_patch(const SenderTree& tree, std::uint32_t id, const Vec3& position, const Vec3& normal,
                      float near_distance, float choice) {
  float probability = 1;
  while (tree.nodes[id].patch == kNone) {
    const SenderNode& node = tree.nodes[id];
    RADFARM_DCHECK(node.child_count <= kMaxChildren);
    std::array<float, kMaxChildren> likely{};
    float total = 0;
    for (std::uint32_t i = 0; i < node.child_count; ++i) {
      const SenderOutline outline = outline_of(tree, node.first_child + i);
      const JudgedIrradiance gives = judge_irradiance(outline, position, normal, near_distance);
      total += likely[i] = gives.likely;
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
