#pragma once

#include <cstdint>

#include "senders/sender_tree.h"

namespace radfarm {

/// What a point needs to know of a sender to judge how much it may give, before anything is sampled.
struct SenderOutline {
  Vec3 center{0, 0, 0};
  Vec3 half{0, 0, 0};       // of the bounding box's size, m
  float radius = 0;         // of a sphere around the center that holds the sender, m
  float area = 0;           // m^2
  Vec3 normal{0, 0, 0};     // unit for patches; zero for clusters, which have no single one
  float power = 0;          // luminance, lm
};
SenderOutline outline_of(const SenderTree& tree, std::uint32_t node);

/// The irradiance (luminance, lux) that the sender is likely to give a point with this normal, unoccluded. Within a small
/// factor of the truth; 0 only where it certainly gives nothing.
float likely_irradiance(const SenderOutline& sender, const Vec3& position, const Vec3& normal);

/// One patch of a sender, drawn for one receiving point.
struct DrawnPatch {
  std::uint32_t node = 0;   // a node with a patch
  float probability = 0;    // of having been drawn; 0: nothing below the sender can give the point anything
};

/// Goes down the tree from `node`, at each cluster to a child with a probability in proportion to what it is likely to give
/// the point, so that a small patch close by is drawn as often as its light is worth. (senders.5) O(depth).
DrawnPatch draw_patch(const SenderTree& tree, std::uint32_t node, const Vec3& position, const Vec3& normal, float choice);

}  // namespace radfarm
