#include "radiosity/solve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "radiosity/direct.h"
#include "radiosity/escape.h"

namespace radfarm {
namespace {

constexpr int kBisections = 40;
constexpr std::size_t kMaxIterations = 2000;  // rho = .999 needs about 7 / (1 - rho) / ln 10 gathers for 1e-3

// A sender is not scaled by more than this: beyond, its links say too little of where its light goes.
constexpr double kMaxScale = 100;

/// Links sorted by receiver, with what each one delivers in the current iteration.
struct Deliveries {
  std::vector<Link> links;
  std::vector<std::uint32_t> first_of_node;  // one a node and one past the last
  std::vector<Spectrum> irradiance;          // lux, at normal incidence for cluster receivers
  std::vector<float> scale;                  // per node, used at undivided patches

  /// Of all links those that carry reflected light: what emitters give is in sample_direct().
  Deliveries(const std::vector<Link>& all, std::size_t nodes) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(links), [](const Link& link) { return link.reflected > 0; });
    std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.receiver < b.receiver; });
    first_of_node.resize(nodes + 1);
    for (const Link& link : links) ++first_of_node[link.receiver + 1];
    std::partial_sum(first_of_node.begin(), first_of_node.end(), first_of_node.begin());
    irradiance.resize(links.size());
  }
};

bool is_undivided(const Node& node) { return !node.is_cluster() && node.child_count == 0; }

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

void pull_up(const Hierarchy& hierarchy, NodePower& power) {
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) power[hierarchy.nodes[i].parent] += power[i];
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

/// (radiosity.6) How much of what each undivided patch reflects its links deliver, and the scale that makes it right: what
/// does not escape arrives. Returns the share of the light that stays which the links had missed.
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

/// What each link delivers of the light sent, normalised.
void deliver(const NodePower& sent, Deliveries& deliveries) {
  parallel_for(deliveries.links.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      deliveries.irradiance[i] = sent[deliveries.links[i].sender] * deliveries.links[i].reflected;
    }
  });
}

/// Irradiance of a patch without parts from other surfaces: from its own links, its wholes' links, and every cluster's above, by its cosine.
SpectrumD gather(const Hierarchy& hierarchy, const Deliveries& deliveries, std::uint32_t leaf) {
  const Vec3 normal = hierarchy.patches[hierarchy.nodes[leaf].patch].normal;
  SpectrumD sum;
  for (std::uint32_t node = leaf; node != kNone; node = hierarchy.nodes[node].parent) {
    for (std::uint32_t i = deliveries.first_of_node[node]; i < deliveries.first_of_node[node + 1]; ++i) {
      const Link& link = deliveries.links[i];
      const bool is_directed = link.has_direction(hierarchy.nodes[node]);
      const float cosine = is_directed ? std::max(0.0F, dot(normal, link.direction)) : 1;
      sum += SpectrumD(deliveries.irradiance[i] * cosine);
    }
  }
  return sum;
}

struct Sweep {
  double change = 0;    // of reflected power, lm
};

/// One Jacobi iteration: deliver what the patches send, normalised; gather, reflect, pull up.
Sweep iterate(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct, Deliveries& deliveries,
              NodePower& reflected) {
  NodePower sent(hierarchy.nodes.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    if (is_undivided(hierarchy.nodes[i])) sent[i] = reflected[i] * deliveries.scale[i];
  }
  pull_up(hierarchy, sent);
  deliver(sent, deliveries);
  NodePower next(hierarchy.nodes.size());
  constexpr std::size_t kGrain = 1024;
  std::vector<Sweep> partial((hierarchy.nodes.size() + kGrain - 1) / kGrain);
  parallel_for(hierarchy.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Sweep& sweep = partial[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      const Node& node = hierarchy.nodes[i];
      if (!is_undivided(node) || is_black(node.reflectance)) continue;
      const SpectrumD arrived = SpectrumD(direct[i]) + gather(hierarchy, deliveries, static_cast<std::uint32_t>(i));
      const SpectrumD power = arrived * static_cast<double>(node.area);
      next[i] = node.reflectance * Spectrum(power);
      sweep.change += std::fabs(static_cast<double>(luminance(next[i]) - luminance(reflected[i])));
    }
  });
  pull_up(hierarchy, next);
  reflected = std::move(next);
  Sweep total;
  for (const Sweep& sweep : partial) total.change += sweep.change;
  return total;
}

/// Iterates from the radiosity known so far until it settles; returns the last iteration's sweep.
Sweep settle(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct, Deliveries& deliveries,
             double max_change, NodePower& reflected, std::size_t& iterations) {
  Sweep sweep;
  for (std::size_t i = 0; i < kMaxIterations; ++i) {
    sweep = iterate(hierarchy, direct, deliveries, reflected);
    ++iterations;
    if (sweep.change <= max_change) break;
  }
  return sweep;
}

void fill_ledger(const World& world, const Hierarchy& hierarchy, const std::vector<Spectrum>& direct,
                 const Deliveries& deliveries, const Sweep& last, EnergyLedger& energy) {
  energy.emitted = world.emitters.total_flux;
  double absorbed = 0;
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (!is_undivided(node)) continue;
    const SpectrumD arrived =
        (SpectrumD(direct[i]) + gather(hierarchy, deliveries, i)) * static_cast<double>(node.area);
    absorbed += luminance(arrived) - luminance(arrived * SpectrumD(node.reflectance));
  }
  energy.absorbed = absorbed;
  energy.truncated = last.change;
  energy.escaped = energy.emitted - energy.absorbed - energy.truncated;
}

/// One pass over links that are ready: normalise, iterate.
void solve_links(const World& world, const std::vector<Link>& links, const RadiositySettings& settings,
                 const std::vector<Spectrum>& direct, std::uint64_t seed, RadiositySolution& solution) {
  const double max_change = static_cast<double>(settings.residual) * world.emitters.total_flux;
  Deliveries deliveries(links, solution.hierarchy.nodes.size());
  const double escaping = probe_escaping(world, solution.hierarchy, seed);
  solution.energy.closure_error = normalise(solution.hierarchy, solution.reflected_power, escaping, deliveries);
  const Sweep last = settle(solution.hierarchy, direct, deliveries, max_change, solution.reflected_power,
                            solution.iterations);
  fill_ledger(world, solution.hierarchy, direct, deliveries, last, solution.energy);
}

}  // namespace

RadiositySolution solve_radiosity(const World& world, const RadiositySettings& settings, std::uint64_t seed) {
  RadiositySolution solution;
  const SideNumbers sides(world.scene);
  solution.hierarchy = build_hierarchy(world, sides, reachable_sides(world, sides, seed));
  solution.reflected_power.resize(solution.hierarchy.nodes.size());
  const double flux = world.emitters.total_flux;
  if (solution.hierarchy.nodes.empty() || !(flux > 0)) return solution;
  std::vector<Link> links = initial_links(world, solution.hierarchy);
  std::vector<Spectrum> direct;
  bool is_last = false;
  while (!is_last) {
    const std::size_t splits =
        refine(world, solution.hierarchy, solution.reflected_power, links, settings, flux, seed);
    is_last = ++solution.passes == settings.max_passes || (splits == 0 && solution.passes > 1);
    if (is_last) measure_again(world, solution.hierarchy, solution.reflected_power, links, settings, seed);
    set_reflected_power(solution.hierarchy, solution.reflected_power);
    sample_direct(world, solution.hierarchy, seed, direct);
    solve_links(world, links, settings, direct, combine(seed, solution.passes), solution);
  }
  solution.links = links.size();
  return solution;
}

}  // namespace radfarm
