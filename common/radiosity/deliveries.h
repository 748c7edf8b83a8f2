#pragma once

#include <vector>

#include "radiosity/refine.h"

namespace radfarm {

/// What one link delivers, packed: the iteration reads every one of them many times.
struct Delivery {
  Vec3 direction{0, 0, 0};       // of cluster receivers: their patches take their cosine to it; zero: no direction
  float factor = 0;              // Link::reflected, 1/m^2
  std::uint32_t receiver = 0;
  std::uint32_t sender = 0;

  bool is_directed() const { return direction != Vec3(0, 0, 0); }
};

/// Links sorted by receiver, with what each one delivers in the current iteration.
struct Deliveries {
  std::vector<Delivery> links;
  std::vector<std::uint32_t> first_of_node;  // one a node and one past the last
  std::vector<std::uint32_t> linked_above;   // one a node: the nearest cluster from it upwards that receives; kNone
  std::vector<std::uint32_t> parents;        // one a node: Node::parent, packed
  std::vector<Spectrum> irradiance;          // one a link, lux, at normal incidence for cluster receivers
  std::vector<float> scale;                  // one a node, used at undivided patches

  /// Of all links those that carry reflected light: what emitters give is in sample_direct().
  Deliveries(const std::vector<Link>& all, const Hierarchy& hierarchy);
};

/// (radiosity.6) How much of what each undivided patch reflects its links deliver, and the scale that makes it right: what
/// does not escape arrives. `escaping`: the share of reflected light that leaves the scene. Returns the share of the light that
/// stays which the links had missed. O(links x leaves below their receivers).
double normalise(const Hierarchy& hierarchy, const NodePower& reflected, double escaping, Deliveries& deliveries);

/// Lets each link deliver of the light sent: `power` is what undivided patches reflect, lm, one a node. O(links + nodes).
void deliver(const NodePower& power, Deliveries& deliveries);

/// Irradiance of every undivided patch from what the links deliver, lux, one a node: from its own links, its wholes', and from those
/// of every cluster above by its cosine. O(leaves x links above each). Same bits for any number of threads.
std::vector<Spectrum> gather(const Hierarchy& hierarchy, const Deliveries& deliveries);

}  // namespace radfarm
