#pragma once

#include <cstdint>

#include "senders/sender_tree.h"

namespace radfarm {

/// What a point needs to know of a sender to judge how much it may give, before anything is sampled.
struct SenderOutline {
  Vec3 center{0, 0, 0};
  Vec3 half{0, 0, 0};       // of the bounding box's size, m
  float radius = 0;         // of a sphere around the center that holds the sender, m
  float max_radiosity = 0;  // luminance, lm/m^2
  Vec3 normal{0, 0, 0};     // unit for patches; zero for clusters, which have no single one
  float plane = 0;          // of patches: normal . x for points x of it
  float power = 0;          // luminance, lm
  std::uint32_t emits = 0;  // 1: some of it is emitted, so near parts count as well
};
static_assert(sizeof(SenderOutline) == 14 * sizeof(float), "stored in grid files: no padding");
SenderOutline outline_of(const SenderTree& tree, std::uint32_t node);

/// Irradiance (luminance, lux) that a sender may give a point, unoccluded.
struct JudgedIrradiance {
  float likely = 0;  // within a small factor of the truth where the sender is far; never far below `bound`
  float bound = 0;   // it gives no more; 0 only where it certainly gives nothing
};

/// Judges by bounding box, power and largest radiosity. Parts of a sender that only reflects do not count where they are closer
/// than `near_distance`: rays, (gather.4), bring those. About 10 ns.
JudgedIrradiance judge_irradiance(const SenderOutline& sender, const Vec3& position, const Vec3& normal, float near_distance);

/// One patch of a sender, drawn for one receiving point.
struct DrawnPatch {
  std::uint32_t node = 0;   // a node with a patch
  float probability = 0;    // of having been drawn; 0: nothing below the sender can give the point anything
};

/// Goes down the tree from `node`, at each cluster to a child with a probability in proportion to what it is likely to give
/// the point, so that a small patch close by is drawn as often as its light is worth. (senders.5) O(depth).
DrawnPatch draw_patch(const SenderTree& tree, std::uint32_t node, const Vec3& position, const Vec3& normal,
                      float near_distance, float choice);

/// How far a point, `offset` from a box's centre, is from the box along each axis; 0 inside.
Vec3 gap_to_box(const Vec3& offset, const Vec3& half);

}  // namespace radfarm
