#pragma once

#include <vector>

#include "radiosity/refine.h"

namespace radfarm {

inline bool is_undivided(const Node& node) { return !node.is_cluster() && node.child_count == 0; }

/// Links sorted by receiver, with what each one delivers in the current iteration.
struct Deliveries {
  std::vector<Link> links;
  std::vector<std::uint32_t> first_of_node;  // one a node and one past the last
  std::vector<Spectrum> irradiance;          // lux, at normal incidence for cluster receivers
  std::vector<float> scale;                  // per node, used at undivided patches

  /// Of all links those that carry reflected light: what emitters give is in sample_direct().
  Deliveries(const std::vector<Link>& all, std::size_t nodes);
};

/// (radiosity.6) How much of what each undivided patch reflects its links deliver, and the scale that makes it right: what
/// does not escape arrives. `escaping`: the share of reflected light that leaves the scene. Returns the share of the light that
/// stays which the links had missed.
double normalise(const Hierarchy& hierarchy, const NodePower& reflected, double escaping, Deliveries& deliveries);

}  // namespace radfarm
