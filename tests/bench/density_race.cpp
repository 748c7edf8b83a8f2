#include "bench/density_race.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "meters/by_gather.h"
#include "paths/density.h"
#include "paths/photon_map.h"

namespace radfarm::bench {
namespace {

double area_of(double radius) { return std::numbers::pi * radius * radius; }

std::vector<double> by_paths(const World& world, const Components& components, const std::vector<Disc>& discs,
                             const Experiment& experiment) {
  const DiscSet set(world, components, discs);
  std::vector<DiscSums> sums(discs.size());
  add_batch(world, set, kAllOrigins, {experiment.seed, 0, experiment.paths}, sums, experiment.rules);
  std::vector<double> lux;
  for (const DiscSums& s : sums) lux.push_back(luminance(s.flux) / static_cast<double>(experiment.paths));
  return lux;
}

std::vector<double> by_map(const World& world, const std::vector<Disc>& discs, const Experiment& experiment) {
  const PhotonMap map(photons_of(world, kAllOrigins, {experiment.seed, 0, experiment.paths}));
  std::vector<double> lux;
  for (const Disc& disc : discs) {
    OrientedDisc shape = disc.shape;
    if (experiment.way == Way::kNearest) shape.radius = map.distance_of(experiment.nearest, shape);
    double flux = 0;
    map.each_near(shape, [&](const Photon& photon) { flux += static_cast<double>(luminance(photon.power)); });
    lux.push_back(flux / area_of(static_cast<double>(shape.radius)) / static_cast<double>(experiment.paths));
  }
  return lux;
}

}  // namespace

Estimates estimate(const World& world, const Components& components, const std::vector<Disc>& discs,
                   const Experiment& experiment) {
  const ThreadLimit alone(1);
  const Stopwatch watch;
  Estimates estimates;
  estimates.lux =
      experiment.way == Way::kPaths ? by_paths(world, components, discs, experiment) : by_map(world, discs, experiment);
  estimates.cpu_seconds = watch.cpu_seconds();
  return estimates;
}

Truth find_truth(const World& world, std::span<const Disc> discs, std::uint64_t samples) {
  std::vector<Meter> meters;
  for (const Disc& disc : discs) meters.push_back({disc.start, disc.shape.normal});
  GatherMeterSettings settings;
  settings.samples = samples;
  Truth truth;
  for (const Reading& reading : measure_by_gather(world, meters, settings)) {
    truth.lux.push_back(reading.lux());
    truth.mean += reading.lux() / static_cast<double>(discs.size());
    truth.variance +=
        std::pow(reading.half_width / 2.131, 2) / static_cast<double>(discs.size());  // Student, 15 degrees
  }
  return truth;
}

double relative_error(const Estimates& estimates, const Truth& truth) {
  double squares = 0;
  for (std::size_t i = 0; i < truth.lux.size(); ++i) squares += std::pow(estimates.lux[i] - truth.lux[i], 2);
  return std::sqrt(std::max(0.0, squares / static_cast<double>(truth.lux.size()) - truth.variance)) / truth.mean;
}

std::vector<Disc> with_radius(std::vector<Disc> discs, float radius) {
  for (Disc& disc : discs) disc.shape.radius = radius;
  return discs;
}

}  // namespace radfarm::bench
