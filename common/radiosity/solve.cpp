#include "radiosity/solve.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "radiosity/deliveries.h"
#include "radiosity/direct.h"
#include "radiosity/escape.h"
#include "radiosity/light_paths.h"

namespace radfarm {
namespace {

constexpr std::size_t kMaxIterations = 2000;  // rho = .999 needs about 7 / (1 - rho) / ln 10 gathers for 1e-3

constexpr double kMinPaths = 1 << 15;
constexpr double kMaxPaths = 1 << 23;  // rays, where light is reflected often

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

/// Paths enough for `hits_per_patch`, by how much light the links found after its first reflection.
std::size_t count_paths(const RadiositySettings& settings, const RadiositySolution& solution) {
  const double bounces = luminance(SpectrumD(solution.reflected_power[0])) / solution.energy.emitted;
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  const auto patches = static_cast<double>(std::count_if(nodes.begin(), nodes.end(), is_undivided));
  const double hits = settings.hits_per_patch * patches;
  return static_cast<std::size_t>(std::clamp(hits / std::max(bounces, 0.05), kMinPaths, kMaxPaths / std::max(bounces, 1.0)));
}

/// Light that arrives at surfaces straight from emitters, lm. Of a sky's, most misses a small scene.
double landed(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct) {
  double sum = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    if (is_undivided(hierarchy.nodes[i])) sum += static_cast<double>(luminance(direct[i]) * hierarchy.nodes[i].area);
  }
  return sum;
}

/// What undivided patches reflect of the light that emitters give them, lm.
std::vector<Spectrum> reflect_direct(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct) {
  std::vector<Spectrum> reflected(hierarchy.nodes.size());
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (is_undivided(node)) reflected[i] = node.reflectance * direct[i] * node.area;
  }
  return reflected;
}

/// (radiosity.7) The light that surfaces exchange, as paths find it; the links' solution is the guess where few paths went.
void follow_paths(const World& world, const SideNumbers& sides, const std::vector<Spectrum>& direct,
                  const RadiositySettings& settings, std::uint64_t seed, RadiositySolution& solution) {
  const Hierarchy& hierarchy = solution.hierarchy;
  const std::vector<Spectrum> reflected = reflect_direct(hierarchy, direct);
  std::vector<Spectrum> indirect(hierarchy.nodes.size());
  for (std::size_t i = 0; i < indirect.size(); ++i) {
    if (is_undivided(hierarchy.nodes[i])) indirect[i] = solution.reflected_power[i] - reflected[i];
  }
  const PathHits hits = follow_light(world, sides, hierarchy, count_paths(settings, solution), seed);
  indirect = combine_with_guess(hierarchy, hits, indirect);
  for (std::size_t i = 0; i < indirect.size(); ++i) solution.reflected_power[i] = reflected[i] + indirect[i];
  pull_up(hierarchy, solution.reflected_power);
  solution.energy.absorbed = hits.absorbed;
  solution.energy.truncated = 0;
  solution.energy.escaped = solution.energy.emitted - hits.absorbed;
}

}  // namespace

RadiositySolution solve_radiosity(const World& world, const RadiositySettings& settings, std::uint64_t seed) {
  RadiositySolution solution;
  const SideNumbers sides(world.scene);
  solution.hierarchy = build_hierarchy(world, sides, reachable_sides(world, sides, seed));
  solution.reflected_power.resize(solution.hierarchy.nodes.size());
  double flux = world.emitters.total_flux;  // that errors are shares of
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
    if (!world.environment.is_empty()) flux = std::min(flux, std::max(landed(solution.hierarchy, direct), 1e-3 * flux));
    solve_links(world, links, settings, direct, combine(seed, solution.passes), solution);
  }
  solution.links = links.size();
  if (settings.hits_per_patch > 0) follow_paths(world, sides, direct, settings, seed, solution);
  return solution;
}

}  // namespace radfarm
