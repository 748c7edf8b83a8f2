#include "radiosity/deliveries.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"

namespace radfarm {
namespace {

constexpr int kBisections = 40;
// A sender is not scaled by more than this: beyond, its links say too little of where its light goes.
constexpr double kMaxScale = 100;

/// The area over which a link's irradiance is received, cosines included, m^2.
double receiving_area(const Hierarchy& hierarchy, const Delivery& link) {
  const Node& receiver = hierarchy.nodes[link.receiver];
  if (!link.is_directed()) return static_cast<double>(receiver.area);
  double area = 0;
  for (std::uint32_t i = receiver.first_leaf; i < receiver.first_leaf + receiver.leaf_count; ++i) {
    const auto cosine = static_cast<double>(std::max(0.0F, dot(hierarchy.leaf_normals[i], link.direction)));
    area += (hierarchy.area_before[i + 1] - hierarchy.area_before[i]) * cosine;
  }
  return area;
}

/// An undivided patch that sends: its power (lm) and the share of it that links deliver.
struct Sending {
  double power = 0;
  double delivered = 0;
};

/// The light that arrives when each patch's light is scaled by the smaller of `scale` and what makes it arrive whole.
double scaled_arrival(const std::vector<Sending>& all, double scale) {
  double arrived = 0;
  for (const Sending& sending : all) arrived += sending.power * std::min(1.0, sending.delivered * scale);
  return arrived;
}

/// The one scale with which `wanted` arrives, no patch sending more than it has: column sums of at most 1 make the
/// iteration converge whenever rho < 1, however noisy the links. By bisection; scaled_arrival() grows with the scale.
double find_scale(const std::vector<Sending>& all, double wanted) {
  double low = 0, high = kMaxScale;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (scaled_arrival(all, middle) < wanted ? low : high) = middle;
  }
  return high;
}

/// What each node's links, and those of all above, deliver of its light: a share. Trims links that deliver more than all.
std::vector<double> delivered_shares(const Hierarchy& hierarchy, Deliveries& deliveries) {
  std::vector<double> areas(deliveries.links.size());
  parallel_for(areas.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) areas[i] = receiving_area(hierarchy, deliveries.links[i]);
  });
  std::vector<double> shares(hierarchy.nodes.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    Delivery& link = deliveries.links[i];
    // No sender gives one receiver more than all it has, whatever its few samples say.
    if (areas[i] > 0) link.factor = std::min(link.factor, static_cast<float>(1 / areas[i]));
    shares[link.sender] += areas[i] * static_cast<double>(link.factor);
  }
  for (std::size_t i = 1; i < shares.size(); ++i) shares[i] += shares[deliveries.parents[i]];
  return shares;
}

/// The links of every cluster above a leaf: the same for all leaves under one cluster, so collected once for a run of them.
struct Above {
  std::uint32_t cluster = kNone;
  Spectrum undirected;
  std::vector<std::uint32_t> directed;
};

void collect(const Deliveries& deliveries, std::uint32_t cluster, Above& above) {
  above.cluster = cluster;
  above.undirected = Spectrum();
  above.directed.clear();
  while (cluster != kNone) {
    for (std::uint32_t i = deliveries.first_of_node[cluster]; i < deliveries.first_of_node[cluster + 1]; ++i) {
      deliveries.links[i].is_directed() ? above.directed.push_back(i) : void(above.undirected += deliveries.irradiance[i]);
    }
    const std::uint32_t parent = deliveries.parents[cluster];
    cluster = parent == kNone ? kNone : deliveries.linked_above[parent];
  }
}

SpectrumD irradiance_from(const Above& above, const Deliveries& deliveries, const Vec3& normal) {
  SpectrumD sum(above.undirected);
  for (const std::uint32_t i : above.directed) {
    const float cosine = dot(normal, deliveries.links[i].direction);
    if (cosine > 0) sum += SpectrumD(deliveries.irradiance[i] * cosine);
  }
  return sum;
}

/// Adds each part's own links to what its whole gets, down to undivided ones.
void spread(const Hierarchy& hierarchy, const Deliveries& deliveries, std::uint32_t id, SpectrumD sum,
            std::vector<Spectrum>& irradiance) {
  for (std::uint32_t i = deliveries.first_of_node[id]; i < deliveries.first_of_node[id + 1]; ++i) {
    sum += SpectrumD(deliveries.irradiance[i]);
  }
  const Node& node = hierarchy.nodes[id];
  if (node.child_count == 0) irradiance[id] = Spectrum(sum);
  for (std::uint32_t c = 0; c < node.child_count; ++c) spread(hierarchy, deliveries, node.first_child + c, sum, irradiance);
}

}  // namespace

Deliveries::Deliveries(const std::vector<Link>& all, const Hierarchy& hierarchy) {
  for (const Link& link : all) {
    if (!(link.reflected > 0)) continue;
    const bool is_directed = link.has_direction(hierarchy.nodes[link.receiver]);
    links.push_back({is_directed ? link.direction : Vec3(0, 0, 0), link.reflected, link.receiver, link.sender});
  }
  std::stable_sort(links.begin(), links.end(), [](const Delivery& a, const Delivery& b) { return a.receiver < b.receiver; });
  const std::size_t nodes = hierarchy.nodes.size();
  first_of_node.resize(nodes + 1);
  for (const Delivery& link : links) ++first_of_node[link.receiver + 1];
  std::partial_sum(first_of_node.begin(), first_of_node.end(), first_of_node.begin());
  linked_above.resize(nodes);
  parents.resize(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) {
    parents[i] = hierarchy.nodes[i].parent;
    const bool is_linked = hierarchy.nodes[i].is_cluster() && first_of_node[i + 1] > first_of_node[i];
    linked_above[i] = is_linked ? i : parents[i] == kNone ? kNone : linked_above[parents[i]];
  }
  irradiance.resize(links.size());
}

double normalise(const Hierarchy& hierarchy, const NodePower& reflected, double escaping, Deliveries& deliveries) {
  const std::vector<double> shares = delivered_shares(hierarchy, deliveries);
  std::vector<Sending> all;
  double sent = 0, arrived = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto power = static_cast<double>(luminance(reflected[i]));
    if (!(power > 0) || !is_undivided(hierarchy.nodes[i])) continue;
    all.push_back({power, shares[i]});
    sent += power;
    arrived += power * shares[i];
  }
  const double stays = (1 - escaping) * sent;
  const double scale = find_scale(all, stays);
  deliveries.scale.resize(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    deliveries.scale[i] = static_cast<float>(std::min(scale, shares[i] > 0 ? 1 / shares[i] : 1));
  }
  return stays > 0 ? 1 - arrived / stays : 0;
}

void deliver(const NodePower& power, Deliveries& deliveries) {
  NodePower sent(power.size());
  for (std::size_t i = sent.size(); i-- > 0;) {
    // Whole patches and clusters hold 0 here until what lies below, which has larger numbers, has been added.
    sent[i] += power[i] * deliveries.scale[i];
    if (i > 0) sent[deliveries.parents[i]] += sent[i];
  }
  parallel_for(deliveries.links.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      deliveries.irradiance[i] = sent[deliveries.links[i].sender] * deliveries.links[i].factor;
    }
  });
}

std::vector<Spectrum> gather(const Hierarchy& hierarchy, const Deliveries& deliveries) {
  std::vector<Spectrum> irradiance(hierarchy.nodes.size());
  parallel_for(hierarchy.leaves.size(), 1024, [&](std::size_t begin, std::size_t end) {
    Above above;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t leaf = hierarchy.leaves[i];
      const std::uint32_t parent = deliveries.parents[leaf];
      const std::uint32_t cluster = parent == kNone ? kNone : deliveries.linked_above[parent];
      if (i == begin || cluster != above.cluster) collect(deliveries, cluster, above);
      spread(hierarchy, deliveries, leaf, irradiance_from(above, deliveries, hierarchy.leaf_normals[i]), irradiance);
    }
  });
  return irradiance;
}

}  // namespace radfarm
