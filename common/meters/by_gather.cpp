#include "meters/by_gather.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "estimate/path_irradiance.h"
#include "math/statistics.h"

namespace radfarm {
namespace {

/// Streams of one meter's random numbers: by replicate, the pilot's apart.
enum Part : std::uint64_t { kOwn, kOnward, kPilotOwn, kPilotOnward };

struct MeterSampler {
  const World& world;
  const SurfacePoint point;
  const std::uint64_t seed;
  const int index;

  SpectrumD mean(Part own, Part onward, std::uint64_t replicate, std::uint64_t paths) const {
    SpectrumD sum;
    Counters counters;
    for (std::uint64_t i = 0; i < paths; ++i) {
      const auto at = static_cast<std::uint32_t>(i);
      const auto stream = [&](Part part) {
        return PixelSampler(combine(seed, replicate), Stream::kMeter, index, static_cast<int>(part), at);
      };
      const Arrived light = path_irradiance(world, point, stream(own), stream(onward), counters);
      sum += SpectrumD(light.direct + light.indirect);
    }
    return sum / static_cast<double>(paths);
  }

  std::array<SpectrumD, kReplicates> replicates(Part own, Part onward, std::uint64_t paths) const {
    std::array<SpectrumD, kReplicates> means;
    const std::uint64_t each = std::max<std::uint64_t>(1, paths / kReplicates);
    for (std::size_t r = 0; r < kReplicates; ++r) means[r] = mean(own, onward, r, each);
    return means;
  }
};

SurfacePoint free_point(const Meter& meter) {
  SurfacePoint point;
  point.position = meter.point;
  point.geometric_normal = point.shading_normal = meter.normal;
  return point;
}

Reading reading_of(const std::array<SpectrumD, kReplicates>& means) {
  Reading reading;
  std::array<double, kReplicates> lux{};
  for (std::size_t r = 0; r < kReplicates; ++r) {
    reading.irradiance += means[r] / static_cast<double>(kReplicates);
    lux[r] = luminance(means[r]);
  }
  reading.half_width = half_width_of(lux);
  return reading;
}

/// So many that the interval is as narrow as is aimed at, if error falls with the root of their number.
std::uint64_t needed(const Reading& pilot, const GatherMeterSettings& settings) {
  const double share = pilot.lux() > 0 ? pilot.half_width / pilot.lux() / settings.error : 1;
  const double paths = static_cast<double>(settings.pilot) * share * share;
  return static_cast<std::uint64_t>(
      std::clamp(paths, static_cast<double>(settings.pilot), static_cast<double>(settings.most)));
}

Reading measure_one(const MeterSampler& meter, const GatherMeterSettings& settings) {
  std::uint64_t paths = settings.samples;
  if (paths == 0) paths = needed(reading_of(meter.replicates(kPilotOwn, kPilotOnward, settings.pilot)), settings);
  Reading reading = reading_of(meter.replicates(kOwn, kOnward, paths));
  reading.samples = std::max<std::uint64_t>(1, paths / kReplicates) * kReplicates;
  return reading;
}

}  // namespace

std::vector<Reading> measure_by_gather(const World& world, std::span<const Meter> meters,
                                       const GatherMeterSettings& settings, const Progress& progress) {
  std::vector<Reading> readings(meters.size());
  parallel_for(progress, "meters", meters.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      readings[i] = measure_one({world, free_point(meters[i]), settings.seed, static_cast<int>(i)}, settings);
    }
  });
  return readings;
}

}  // namespace radfarm
