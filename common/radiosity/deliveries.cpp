#include "radiosity/deliveries.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/parallel.h"

namespace radfarm {
namespace {

constexpr int kBisections = 40;
// A sender is not scaled by more than this: beyond, its links say too little of where its light goes.
constexpr double kMaxScale = 100;

/// The area over which a link's irradiance is received, cosines included, m^2.
double receiving_area(const Hierarchy& hierarchy, const Link& link) {
  const Node& receiver = hierarchy.nodes[link.receiver];
  if (!link.has_direction(receiver)) return static_cast<double>(receiver.area);
  double area = 0;
  for (std::uint32_t i = receiver.first_leaf; i < receiver.first_leaf + receiver.leaf_count; ++i) {
    const Node& leaf = hierarchy.nodes[hierarchy.leaves[i]];
    area += static_cast<double>(leaf.area * std::max(0.0F, dot(hierarchy.patches[leaf.patch].normal, link.direction)));
  }
  return area;
}

/// Reflected light on its way to being normalised.
struct Part {
  std::vector<double> delivered;  // per node: the share of its light that links from it, and from all above, deliver
  double sent = 0;                // lm
  double arrived = 0;
};

/// The light that arrives when each patch's light is scaled by the smaller of `scale` and what makes it arrive whole.
double scaled_arrival(const Hierarchy& hierarchy, const NodePower& power, const Part& part, double scale) {
  double arrived = 0;
  for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
    if (!is_undivided(hierarchy.nodes[i])) continue;
    arrived += static_cast<double>(luminance(power[i])) * std::min(1.0, part.delivered[i] * scale);
  }
  return arrived;
}

/// The one scale with which what stays arrives, no patch sending more than it has: column sums of at most 1 make the
/// iteration converge whenever rho < 1, however noisy the links. By bisection; scaled_arrival() grows with the scale.
double find_scale(const Hierarchy& hierarchy, const NodePower& power, const Part& part, double escaping) {
  const double wanted = (1 - escaping) * part.sent;
  double low = 0, high = kMaxScale;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (scaled_arrival(hierarchy, power, part, middle) < wanted ? low : high) = middle;
  }
  return high;
}

}  // namespace

Deliveries::Deliveries(const std::vector<Link>& all, std::size_t nodes) {
  std::copy_if(all.begin(), all.end(), std::back_inserter(links), [](const Link& link) { return link.reflected > 0; });
  std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.receiver < b.receiver; });
  first_of_node.resize(nodes + 1);
  for (const Link& link : links) ++first_of_node[link.receiver + 1];
  std::partial_sum(first_of_node.begin(), first_of_node.end(), first_of_node.begin());
  irradiance.resize(links.size());
}

double normalise(const Hierarchy& hierarchy, const NodePower& reflected, double escaping, Deliveries& deliveries) {
  const std::size_t count = hierarchy.nodes.size();
  std::vector<double> areas(deliveries.links.size());
  parallel_for(areas.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) areas[i] = receiving_area(hierarchy, deliveries.links[i]);
  });
  Part part{std::vector<double>(count)};
  for (std::size_t i = 0; i < areas.size(); ++i) {
    // No sender gives one receiver more than all it has, whatever its few samples say.
    if (areas[i] > 0) {
      deliveries.links[i].reflected = std::min(deliveries.links[i].reflected, static_cast<float>(1 / areas[i]));
    }
    part.delivered[deliveries.links[i].sender] += areas[i] * static_cast<double>(deliveries.links[i].reflected);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = hierarchy.nodes[i];
    if (i > 0) part.delivered[i] += part.delivered[node.parent];
    if (!is_undivided(node)) continue;
    part.sent += static_cast<double>(luminance(reflected[i]));
    part.arrived += static_cast<double>(luminance(reflected[i])) * part.delivered[i];
  }
  const double scale = find_scale(hierarchy, reflected, part, escaping);
  deliveries.scale.assign(count, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = part.delivered[i];
    deliveries.scale[i] = static_cast<float>(std::min(scale, share > 0 ? 1 / share : 1));
  }
  const double stays = (1 - escaping) * part.sent;
  return stays > 0 ? 1 - part.arrived / stays : 0;
}

}  // namespace radfarm
