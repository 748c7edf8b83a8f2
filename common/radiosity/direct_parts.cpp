#include "radiosity/direct_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "radiosity/deliveries.h"
#include "radiosity/direct.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPartsKey = 0x7061727473;  // "parts"
constexpr std::uint32_t kPoints = 32;     // of a patch, each with two estimates of its direct light
constexpr double kShareOfLinks = 0.5;      // of max_link_error: what a patch's mean may misplace
constexpr float kLeastReflectance = 0.1F;  // nothing is cut for what a darker patch reflects
constexpr float kLeastArea = 0.3F;         // of the least area of patches that links cut: edges of shadows are finer than links need

/// What one mean of a patch's direct light puts in the wrong place, lm of reflected power.
struct Trial {
  std::uint32_t node = 0;
  double received = 0;   // lux
  double misplaced = 0;  // lm
};

double reflected_area(const Node& node) {
  const float rho = luminance(node.reflectance);
  return rho < kLeastReflectance ? 0 : static_cast<double>(rho * node.area);
}

/// How much direct light differs from point to point: two independent estimates at each have that variance in common, and nothing of
/// what chance gave them.
Trial try_patch(const World& world, const Hierarchy& hierarchy, std::uint32_t id, std::uint64_t seed) {
  const Node& node = hierarchy.nodes[id];
  double first = 0, second = 0, product = 0;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const std::array<float, 2> lux = estimate_twice(world, hierarchy.patches[node.patch], k, combine(seed, kPartsKey, id));
    first += static_cast<double>(lux[0]);
    second += static_cast<double>(lux[1]);
    product += static_cast<double>(lux[0]) * static_cast<double>(lux[1]);
  }
  const double covariance = (product - first * second / kPoints) / (kPoints - 1);
  return {id, (first + second) / (2 * kPoints), reflected_area(node) * std::sqrt(std::max(0.0, covariance))};
}

/// Patches that could misplace so much at all: by all that they reflect.
bool is_worth_trying(const Node& node, double received, float min_area, double bound) {
  return is_undivided(node) && node.area > min_area && reflected_area(node) * received > bound;
}

}  // namespace

std::size_t cut_by_direct_light(const World& world, const RadiositySettings& settings, double flux, std::uint64_t seed,
                                Hierarchy& hierarchy, std::vector<Spectrum>& direct, std::vector<Spectrum>& reflected,
                                const Progress& progress) {
  const double bound = kShareOfLinks * static_cast<double>(settings.max_link_error) * flux;
  const float min_area = kLeastArea * settings.min_patch_area * hierarchy.nodes[0].area;
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    if (is_worth_trying(hierarchy.nodes[i], static_cast<double>(luminance(direct[i])), min_area, bound)) nodes.push_back(i);
  }
  std::size_t cuts = 0;
  while (!nodes.empty() && cuts < kMaxDirectCuts && !progress.is_cancelled()) {
    std::vector<Trial> trials(nodes.size());
    parallel_for(progress, "radiosity: direct light", nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) trials[i] = try_patch(world, hierarchy, nodes[i], seed);
    });
    std::erase_if(trials, [&](const Trial& trial) { return trial.misplaced <= bound; });
    std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.misplaced > b.misplaced; });
    trials.resize(std::min(trials.size(), kMaxDirectCuts - cuts));
    cuts += trials.size();
    nodes.clear();
    for (const Trial& trial : trials) {
      const std::uint32_t part = subdivide(hierarchy, trial.node);
      direct.insert(direct.end(), 4, kNotSampled);
      reflected.insert(reflected.end(), 4, reflected[trial.node] * 0.25F);
      for (std::uint32_t c = part; c < part + 4; ++c) {
        if (is_worth_trying(hierarchy.nodes[c], trial.received, min_area, bound)) nodes.push_back(c);
      }
    }
  }
  return cuts;
}

}  // namespace radfarm
