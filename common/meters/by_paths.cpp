#include "meters/by_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "paths/density.h"
#include "paths/radius.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPilotKey = 0x70696c6f74;  // "pilot"
constexpr std::uint64_t kPilotShare = 64;          // of the paths: one in so many more decides radii
constexpr float kMostShare = 1.0F / 50;            // of the scene's radius

std::vector<Disc> discs_at(std::span<const Meter> meters, std::span<const float> radii) {
  std::vector<Disc> discs;
  discs.reserve(meters.size());
  for (std::size_t i = 0; i < meters.size(); ++i)
    discs.push_back(disc_in_air(meters[i].point, meters[i].normal, radii[i]));
  return discs;
}

using Replicates = std::vector<std::vector<DiscSums>>;  // one a replicate, one a disc

Replicates run(const World& world, const DiscSet& set, const PathMeterSettings& settings, std::uint64_t seed,
               std::uint64_t paths_each, const Progress& progress) {
  Replicates sums(kReplicates, std::vector<DiscSums>(set.discs().size()));
  parallel_for(progress, "light paths", kReplicates, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) add_batch(world, set, settings.origins, {seed, r, paths_each}, sums[r]);
  });
  return sums;
}

DiscSums total(const Replicates& sums, std::size_t disc) {
  DiscSums all;
  for (const auto& one : sums) all += one[disc];
  return all;
}

/// Each as wide as the pilot's density asks for.
std::vector<float> radii_by_pilot(const World& world, const Components& components, std::span<const Meter> meters,
                                  const PathMeterSettings& settings, const Progress& progress) {
  const float most = settings.most > 0 ? settings.most : kMostShare * world.radius;
  const DiscSet set(world, components, discs_at(meters, std::vector<float>(meters.size(), most)));
  const std::uint64_t each = std::max<std::uint64_t>(1, settings.paths / kPilotShare / kReplicates);
  const Replicates sums = run(world, set, settings, combine(settings.seed, kPilotKey), each, progress);
  const RadiusRule rule{settings.crossings, most / 16, most};
  std::vector<float> radii;
  for (std::size_t i = 0; i < meters.size(); ++i) {
    radii.push_back(choose_radius(set.discs()[i], total(sums, i), static_cast<double>(each * kReplicates),
                                  static_cast<double>(settings.paths), rule));
  }
  return radii;
}

/// Of no crossing in n paths, each of `flux` lm, fewer than three were expected, at 95 %.
double most_unseen(double flux, double paths, float radius) {
  return 3 * flux / (paths * std::numbers::pi * static_cast<double>(radius) * static_cast<double>(radius));
}

Reading reading_of(const Replicates& sums, std::size_t disc, double paths_each) {
  Reading reading;
  std::array<double, kReplicates> lux{}, inner{};
  for (std::size_t r = 0; r < kReplicates; ++r) {
    const DiscSums& one = sums[r][disc];
    reading.irradiance += one.flux / (paths_each * kReplicates);
    reading.samples += one.crossings;
    lux[r] = luminance(one.flux) / paths_each;
    inner[r] = one.inner / paths_each - lux[r];
  }
  // The bias goes with the disc's area: the inner half has half of it. What chance alone explains of the difference
  // counts little.
  double difference = 0;
  for (const double d : inner) difference += d / kReplicates;
  const double chance = half_width_of(inner), squares = difference * difference;
  const double bias = squares > 0 ? 2 * std::fabs(difference) * squares / (squares + chance * chance) : 0;
  reading.half_width = half_width_of(lux) + bias;
  return reading;
}

}  // namespace

PathReadings measure_by_paths(const World& world, std::span<const Meter> meters, const PathMeterSettings& settings,
                              const Progress& progress) {
  const Components components(world.scene);
  PathReadings result;
  result.radii = settings.radius > 0 ? std::vector<float>(meters.size(), settings.radius)
                                     : radii_by_pilot(world, components, meters, settings, progress);
  const DiscSet set(world, components, discs_at(meters, result.radii));
  const std::uint64_t each = std::max<std::uint64_t>(1, settings.paths / kReplicates);
  const Replicates sums = run(world, set, settings, settings.seed, each, progress);
  for (std::size_t i = 0; i < meters.size(); ++i) {
    Reading reading = reading_of(sums, i, static_cast<double>(each));
    if (reading.samples == 0) {
      reading.half_width =
          most_unseen(world.emitters.total_flux, static_cast<double>(each * kReplicates), result.radii[i]);
    }
    result.readings.push_back(reading);
  }
  return result;
}

}  // namespace radfarm
