#include "paths/radius.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"
#include "paths/photon_map.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPilotKey = 0x70696c6f74;  // "pilot"
constexpr std::uint64_t kPilotShare = 64;
constexpr std::uint64_t kPilotBatches = 8;
constexpr double kPilotNearest = 12;  // photons: a radius within 15 %
constexpr std::size_t kGrain = 256;

/// What batches of so many paths each brought each disc.
std::vector<DiscSums> run_pilot(const World& world, const DiscSet& set, OriginSet origins, std::uint64_t seed,
                                std::uint64_t each) {
  std::vector<std::vector<DiscSums>> parts(kPilotBatches, std::vector<DiscSums>(set.discs().size()));
  parallel_for(kPilotBatches, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) add_batch(world, set, origins, {seed, b, each}, parts[b]);
  });
  for (std::size_t b = 1; b < kPilotBatches; ++b) {
    for (std::size_t i = 0; i < parts[b].size(); ++i) parts[0][i] += parts[b][i];
  }
  return std::move(parts[0]);
}

/// The photons of a pilot in batches of so many paths each.
std::vector<Photon> photons_of_pilot(const World& world, OriginSet origins, std::uint64_t seed, std::uint64_t each) {
  std::vector<std::vector<Photon>> parts(kPilotBatches);
  parallel_for(kPilotBatches, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) parts[b] = photons_of(world, origins, {seed, b, each});
  });
  std::vector<Photon> all;
  for (const std::vector<Photon>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

float choose_radius(const Disc& disc, const DiscSums& pilot, double pilot_paths, double paths, const RadiusRule& rule) {
  if (pilot.crossings == 0) return rule.most;
  const double expected = static_cast<double>(pilot.crossings) * paths / pilot_paths;
  const double radius = static_cast<double>(disc.shape.radius) * std::sqrt(rule.crossings / expected);
  return std::clamp(static_cast<float>(radius), std::min(rule.least, rule.most), rule.most);
}

std::vector<float> radii_by_pilot(const World& world, const Components& components, std::vector<Disc> discs,
                                  OriginSet origins, const PathBatch& paths, double crossings,
                                  std::span<const float> least, float most) {
  for (Disc& disc : discs) disc.shape.radius = most;
  const DiscSet set(world, components, std::move(discs));
  const std::uint64_t each = std::max<std::uint64_t>(1, paths.paths / kPilotShare / kPilotBatches);
  const std::vector<DiscSums> pilot = run_pilot(world, set, origins, combine(paths.seed, kPilotKey), each);
  std::vector<float> radii;
  for (std::size_t i = 0; i < pilot.size(); ++i) {
    radii.push_back(choose_radius(set.discs()[i], pilot[i], static_cast<double>(each * kPilotBatches),
                                  static_cast<double>(paths.paths), {crossings, least[i], most}));
  }
  return radii;
}

std::vector<float> radii_by_nearest(const World& world, std::span<const Disc> discs, OriginSet origins,
                                    const PathBatch& paths, double nearest, std::span<const float> least, float most) {
  const double counted = std::min(nearest, kPilotNearest);
  const auto each = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(static_cast<double>(paths.paths) * counted / nearest) / kPilotBatches);
  const PhotonMap map(photons_of_pilot(world, origins, combine(paths.seed, kPilotKey), each));
  const double area = nearest / counted * static_cast<double>(each * kPilotBatches) / static_cast<double>(paths.paths);
  std::vector<float> radii(discs.size());
  parallel_for(discs.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const OrientedDisc widest{discs[i].shape.centre, discs[i].shape.normal, most};
      const float found = map.distance_of(static_cast<std::size_t>(std::ceil(counted)), widest);
      const float radius = found < most ? found * static_cast<float>(std::sqrt(area)) : most;
      radii[i] = std::clamp(radius, std::min(least[i], most), most);
    }
  });
  return radii;
}

}  // namespace radfarm
