#include "radiosity/solve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace radfarm {
namespace {

constexpr std::size_t kMaxIterations = 2000;  // rho = .999 needs about 7 / (1 - rho) / ln 10 gathers for 1e-3

/// Links sorted by receiver, with what each one delivers in the current iteration.
struct Deliveries {
  std::vector<Link> links;
  std::vector<std::uint32_t> first_of_node;  // one a node and one past the last
  std::vector<Spectrum> irradiance;          // lux, at normal incidence for cluster receivers

  explicit Deliveries(std::vector<Link> unsorted, std::size_t nodes) : links(std::move(unsorted)) {
    std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.receiver < b.receiver; });
    first_of_node.resize(nodes + 1);
    for (const Link& link : links) ++first_of_node[link.receiver + 1];
    std::partial_sum(first_of_node.begin(), first_of_node.end(), first_of_node.begin());
    irradiance.resize(links.size());
  }
};

Spectrum tint(const Spectrum& colour) { return colour / luminance(colour); }

void deliver(const World& world, const Hierarchy& hierarchy, const NodePower& reflected, Deliveries& deliveries) {
  parallel_for(deliveries.links.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Link& link = deliveries.links[i];
      if (is_punctual(link.sender)) {
        deliveries.irradiance[i] = tint(world.emitters.punctual[punctual_index(link.sender)].intensity) * link.emitted;
      } else {
        deliveries.irradiance[i] = hierarchy.nodes[link.sender].emitted_power * link.emitted +
                                   reflected[link.sender] * link.reflected;
      }
    }
  });
}

/// Irradiance of a patch without parts: from its own links, its wholes' links, and every cluster's above, by its cosine.
SpectrumD gather(const Hierarchy& hierarchy, const Deliveries& deliveries, std::uint32_t leaf) {
  const Vec3 normal = hierarchy.patches[hierarchy.nodes[leaf].patch].normal;
  SpectrumD sum;
  for (std::uint32_t node = leaf; node != kNone; node = hierarchy.nodes[node].parent) {
    const bool is_cluster = hierarchy.nodes[node].is_cluster();
    for (std::uint32_t i = deliveries.first_of_node[node]; i < deliveries.first_of_node[node + 1]; ++i) {
      const float cosine = is_cluster ? std::max(0.0F, dot(normal, deliveries.links[i].direction)) : 1;
      sum += SpectrumD(deliveries.irradiance[i] * cosine);
    }
  }
  return sum;
}

struct Sweep {
  double arrived = 0;   // lm
  double change = 0;    // of reflected power, lm
};

/// One Jacobi iteration: deliver, gather at every undivided patch, reflect, pull up.
Sweep iterate(const World& world, const Hierarchy& hierarchy, Deliveries& deliveries, NodePower& reflected) {
  deliver(world, hierarchy, reflected, deliveries);
  NodePower next(hierarchy.nodes.size());
  constexpr std::size_t kGrain = 1024;
  const std::size_t pieces = (hierarchy.nodes.size() + kGrain - 1) / kGrain;
  std::vector<Sweep> partial(pieces);
  parallel_for(hierarchy.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Sweep& sweep = partial[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      const Node& node = hierarchy.nodes[i];
      if (node.is_cluster() || node.child_count > 0) continue;
      const SpectrumD power = gather(hierarchy, deliveries, static_cast<std::uint32_t>(i)) * static_cast<double>(node.area);
      next[i] = node.reflectance * Spectrum(power);
      sweep.arrived += luminance(power);
      sweep.change += std::fabs(static_cast<double>(luminance(next[i]) - luminance(reflected[i])));
    }
  });
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) next[hierarchy.nodes[i].parent] += next[i];
  reflected = std::move(next);
  Sweep total;
  for (const Sweep& sweep : partial) total.arrived += sweep.arrived, total.change += sweep.change;
  return total;
}

void fill_ledger(const World& world, const Hierarchy& hierarchy, const Deliveries& deliveries, const Sweep& last,
                 EnergyLedger& energy) {
  energy.emitted = world.emitters.total_flux;
  double absorbed = 0;
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (node.is_cluster() || node.child_count > 0) continue;
    const SpectrumD arrived = gather(hierarchy, deliveries, i) * static_cast<double>(node.area);
    absorbed += luminance(arrived) - luminance(arrived * SpectrumD(node.reflectance));
  }
  energy.absorbed = absorbed;
  energy.truncated = last.change;
  energy.escaped = energy.emitted - energy.absorbed - energy.truncated;
}

}  // namespace

RadiositySolution solve_radiosity(const World& world, const RadiositySettings& settings, std::uint64_t seed) {
  RadiositySolution solution;
  Hierarchy& hierarchy = solution.hierarchy;
  hierarchy = build_hierarchy(world);
  NodePower reflected(hierarchy.nodes.size());
  const double flux = world.emitters.total_flux;
  if (!hierarchy.nodes.empty() && flux > 0) {
    std::vector<Link> links = initial_links(world, hierarchy);
    for (solution.passes = 0; solution.passes < settings.max_passes;) {
      const std::size_t splits = refine(world, hierarchy, reflected, links, settings, flux, seed);
      if (splits == 0 && solution.passes > 0) break;
      ++solution.passes;
      Deliveries deliveries(links, hierarchy.nodes.size());
      Sweep sweep;
      for (std::size_t i = 0; i < kMaxIterations; ++i, ++solution.iterations) {
        sweep = iterate(world, hierarchy, deliveries, reflected);
        if (sweep.change <= static_cast<double>(settings.residual) * flux) break;
      }
      fill_ledger(world, hierarchy, deliveries, sweep, solution.energy);
    }
    solution.links = links.size();
  }
  solution.reflected_power = std::move(reflected);
  return solution;
}

}  // namespace radfarm
