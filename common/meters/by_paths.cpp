#include "meters/by_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "paths/density.h"
#include "paths/radius.h"

namespace radfarm {
namespace {

std::vector<Disc> discs_at(std::span<const Meter> meters, std::span<const float> radii) {
  std::vector<Disc> discs;
  discs.reserve(meters.size());
  for (std::size_t i = 0; i < meters.size(); ++i) {
    discs.push_back(disc_in_air(meters[i].point, meters[i].normal, radii[i]));
  }
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

/// Each as wide as the density of paths asks for.
std::vector<float> choose_radii(const World& world, const Components& components, std::span<const Meter> meters,
                                const PathMeterSettings& settings) {
  const float most = settings.most > 0 ? settings.most : kMostRadius * world.radius;
  const std::vector<float> least(meters.size(), most / 16), widest(meters.size(), most);
  return radii_by_pilot(world, components, discs_at(meters, widest), settings.origins,
                        {settings.seed, 0, settings.paths}, settings.crossings, least, most);
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
                                     : choose_radii(world, components, meters, settings);
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
