#include "radiosity/solve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "radiosity/deliveries.h"
#include "radiosity/direct.h"
#include "radiosity/direct_parts.h"
#include "radiosity/escape.h"
#include "radiosity/light_paths.h"
#include "radiosity/path_posterior.h"
#include "radiosity/specular_light.h"

namespace radfarm {
namespace {

constexpr std::size_t kMaxIterations = 20000;  // rho = .999 needs ln(1e3) / (1 - rho) = 6908 for a residual of 1e-3

constexpr double kSteeringResidual = 10;  // times RadiositySettings::residual

constexpr double kMinPaths = 1 << 15;
constexpr double kMaxRays = 1 << 23;

/// What the patches reflect of an irradiance: rho A, one a node; zero where a node is no undivided patch.
std::vector<Spectrum> responses(const Hierarchy& hierarchy) {
  std::vector<Spectrum> response(hierarchy.nodes.size());
  for (std::size_t i = 0; i < response.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (is_undivided(node)) response[i] = node.reflectance * node.area;
  }
  return response;
}

/// One Jacobi iteration: deliver what the patches send, normalised; gather, reflect. Returns the change of reflected power, lm.
double iterate(const Hierarchy& hierarchy, const std::vector<Spectrum>& response, const std::vector<Spectrum>& direct,
               Deliveries& deliveries, NodePower& reflected) {
  deliver(reflected, deliveries);
  const std::vector<Spectrum> indirect = gather(hierarchy, deliveries);
  constexpr std::size_t kGrain = 4096;
  std::vector<double> changes((reflected.size() + kGrain - 1) / kGrain);
  parallel_for(reflected.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Spectrum next = is_black(response[i]) ? Spectrum() : response[i] * (direct[i] + indirect[i]);
      changes[begin / kGrain] += std::fabs(static_cast<double>(luminance(next) - luminance(reflected[i])));
      reflected[i] = next;
    }
  });
  return std::accumulate(changes.begin(), changes.end(), 0.0);
}

/// Iterates from the radiosity known so far until it settles; returns the last iteration's change, lm.
double settle(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct, double max_change, Deliveries& deliveries,
              const Progress& progress, RadiositySolution& solution) {
  NodePower& reflected = solution.reflected_power;
  const std::vector<Spectrum> response = responses(hierarchy);
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    if (!is_undivided(hierarchy.nodes[i])) reflected[i] = Spectrum();
  }
  double change = 0;
  for (std::size_t i = 0; i < kMaxIterations; ++i) {
    change = iterate(hierarchy, response, direct, deliveries, reflected);
    ++solution.iterations;
    progress.report("radiosity: solving", i + 1);
    if (change <= max_change || progress.is_cancelled()) break;
  }
  pull_up(hierarchy, reflected);
  return change;
}

void fill_ledger(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct, const Deliveries& deliveries, double truncated,
                 EnergyLedger& energy) {
  const std::vector<Spectrum> indirect = gather(hierarchy, deliveries);
  double absorbed = 0;
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (!is_undivided(node)) continue;
    const SpectrumD arrived = (SpectrumD(direct[i]) + SpectrumD(indirect[i])) * static_cast<double>(node.area);
    absorbed += luminance(arrived) - luminance(arrived * SpectrumD(node.reflectance));
  }
  energy.absorbed = absorbed;
  energy.truncated = truncated;
  energy.escaped = energy.emitted - energy.absorbed - energy.truncated;
}

/// One pass over links that are ready: normalise, iterate.
void solve_links(const World& world, const std::vector<Link>& links, double residual, const std::vector<Spectrum>& direct,
                 std::uint64_t seed, const Progress& progress, RadiositySolution& solution) {
  progress.report("radiosity: solving");
  const double max_change = residual * solution.energy.emitted;
  Deliveries deliveries(links, solution.hierarchy);
  const double escaping = probe_escaping(world, solution.hierarchy, seed);
  solution.energy.closure_error = normalise(solution.hierarchy, solution.reflected_power, escaping, deliveries);
  const double change = settle(solution.hierarchy, direct, max_change, deliveries, progress, solution);
  fill_ledger(solution.hierarchy, direct, deliveries, change, solution.energy);
}

/// Paths enough for `hits_per_patch`, by how much light the links found after its first reflection.
std::size_t count_paths(const RadiositySettings& settings, const RadiositySolution& solution) {
  const double bounces = luminance(SpectrumD(solution.reflected_power[0])) / solution.energy.emitted;
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  const auto patches = static_cast<double>(std::count_if(nodes.begin(), nodes.end(), is_undivided));
  const double hits = settings.hits_per_patch * patches;
  const double paths = std::max(hits / std::max(bounces, 0.05), kMinPaths);
  return static_cast<std::size_t>(std::min(paths, kMaxRays / std::max(bounces, 1.0)));
}

/// Irradiance before any reflection among diffuse surfaces: what emitters give, and what specular paths bring.
std::vector<Spectrum> add_specular(std::vector<Spectrum> direct, const std::vector<Spectrum>& specular) {
  for (std::size_t i = 0; i < specular.size(); ++i) direct[i] += specular[i];
  return direct;
}

/// Light that arrives at surfaces before any reflection, lm. Less than is emitted where it shines from outside.
double landed(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct) {
  double sum = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    if (is_undivided(hierarchy.nodes[i])) sum += static_cast<double>(luminance(direct[i]) * hierarchy.nodes[i].area);
  }
  return sum;
}

/// Whether there is light of which most misses a small scene: of a sky or a direction.
bool shines_from_outside(const World& world) {
  const auto is_directional = [](const PunctualEmitter& light) { return light.kind == PunctualLight::Kind::kDirectional; };
  return !world.environment.is_empty() || std::ranges::any_of(world.emitters.punctual, is_directional);
}

/// What undivided patches reflect of the light that emitters and specular paths give them, lm.
std::vector<Spectrum> reflect_direct(const Hierarchy& hierarchy, const std::vector<Spectrum>& direct) {
  std::vector<Spectrum> reflected(hierarchy.nodes.size());
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (is_undivided(node)) reflected[i] = node.reflectance * direct[i] * node.area;
  }
  return reflected;
}

/// What specular paths bring is known before any link is.
void start_with_specular(const Hierarchy& hierarchy, const std::vector<Spectrum>& specular, NodePower& reflected) {
  if (specular.empty()) return;
  reflected = reflect_direct(hierarchy, specular);
  pull_up(hierarchy, reflected);
}

/// (radiosity.7) The light that surfaces exchange, as paths find it; the links' solution is the guess where few paths went.
void follow_paths(const World& world, const SideNumbers& sides, const RadiositySettings& settings, std::uint64_t seed,
                  const Progress& progress, RadiositySolution& solution) {
  const Hierarchy& hierarchy = solution.hierarchy;
  const std::vector<Spectrum>& reflected = solution.reflected_direct;
  std::vector<Spectrum> indirect(hierarchy.nodes.size());
  for (std::size_t i = 0; i < indirect.size(); ++i) {
    if (is_undivided(hierarchy.nodes[i])) indirect[i] = solution.reflected_power[i] - reflected[i];
  }
  PathHits hits = follow_light(world, sides, hierarchy, count_paths(settings, solution), seed, progress);
  balance(hits);
  indirect = combine_with_guess(hierarchy, hits, indirect);
  for (std::size_t i = 0; i < indirect.size(); ++i) solution.reflected_power[i] = reflected[i] + indirect[i];
  pull_up(hierarchy, solution.reflected_power);
  solution.energy.emitted = std::min(solution.energy.emitted, world.emitters.total_flux);  // what mirrors send on is no new light
  solution.energy.absorbed = hits.absorbed;
  solution.energy.truncated = 0;
  solution.energy.escaped = solution.energy.emitted - hits.absorbed;
}

/// All that specular surfaces bring, lm (luminance).
double specular_flux(const Hierarchy& hierarchy, const std::vector<Spectrum>& specular) {
  double flux = 0;
  for (std::size_t i = 0; i < specular.size(); ++i) flux += static_cast<double>(luminance(specular[i]) * hierarchy.nodes[i].area);
  return flux;
}

}  // namespace

RadiositySolution solve_radiosity(const World& world, const RadiositySettings& settings, std::uint64_t seed,
                                  const Progress& progress) {
  RadiositySolution solution;
  const SideNumbers sides(world.scene);
  const std::vector<Spectrum> of_sides = specular_irradiance(world, sides, seed);
  const std::vector<bool> reachable = reachable_sides(world, sides, seed, progress, of_sides);
  solution.hierarchy = build_hierarchy(world, sides, reachable, progress);
  const Hierarchy& hierarchy = solution.hierarchy;
  solution.reflected_power.resize(hierarchy.nodes.size());
  solution.specular = specular_at_patches(of_sides, sides, hierarchy);
  double flux = world.emitters.total_flux + specular_flux(hierarchy, solution.specular);  // that errors are shares of
  if (hierarchy.nodes.empty() || !(flux > 0)) return solution;
  solution.energy.emitted = flux;
  start_with_specular(hierarchy, solution.specular, solution.reflected_power);
  std::vector<Link> links = initial_links(world, hierarchy);
  std::vector<Spectrum> direct, first;
  bool is_last = false;
  while (!is_last && !progress.is_cancelled()) {
    const std::size_t splits =
        refine(world, solution.hierarchy, solution.reflected_power, links, settings, flux, seed, progress);
    is_last = ++solution.passes == settings.max_passes || (splits == 0 && solution.passes > 1);
    if (is_last) measure_again(world, solution.hierarchy, solution.reflected_power, links, settings, seed, progress);
    set_reflected_power(solution.hierarchy, solution.reflected_power);
    sample_direct(world, hierarchy, settings.direct_samples, seed, direct, progress);
    if (is_last) {
      cut_by_direct_light(world, settings, flux, seed, solution.hierarchy, direct, solution.reflected_power, progress);
      sample_direct(world, hierarchy, settings.direct_samples, seed, direct, progress);
    }
    solution.specular = specular_at_patches(of_sides, sides, hierarchy);  // patches were cut
    first = add_specular(direct, solution.specular);
    if (shines_from_outside(world)) flux = std::min(flux, std::max(landed(hierarchy, first), 1e-3 * flux));
    // Passes before the last only steer the refinement.
    const double residual = static_cast<double>(settings.residual) * (is_last ? 1 : kSteeringResidual);
    solve_links(world, links, residual, first, combine(seed, solution.passes), progress, solution);
  }
  solution.links = links.size();
  if (progress.is_cancelled()) return solution;
  solution.reflected_direct = reflect_direct(hierarchy, direct);
  if (settings.hits_per_patch > 0) {
    follow_paths(world, sides, settings, seed, progress, solution);
  }
  return solution;
}

}  // namespace radfarm
