#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "meters/meter.h"
#include "scene/world.h"

namespace radfarm {

struct GatherMeterSettings {
  double error = .02;            // aimed at: half the width of the 95 % interval over the reading
  std::uint64_t pilot = 1024;    // paths a meter that decide how many it gets; in no reading
  std::uint64_t most = 1 << 17;  // paths a meter
  std::uint64_t samples = 0;     // paths a meter; 0: by `error`
  std::uint64_t seed = 1;
};

/// Readings by unbiased paths from each meter into the scene (path_irradiance): all light but what no such path meets.
/// docs/pipeline.md (meters.1) A reading depends on its meter's place in the list, the seed and the settings alone. On
/// all threads; cost: some 5 us a path.
std::vector<Reading> measure_by_gather(const World& world, std::span<const Meter> meters,
                                       const GatherMeterSettings& settings, const Progress& progress = {});

}  // namespace radfarm
