#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "meters/meter.h"
#include "paths/photon_path.h"
#include "scene/world.h"

namespace radfarm {

struct PathMeterSettings {
  std::uint64_t paths = 4'000'000;  // light paths of the whole scene
  float radius = 0;                 // m, of all discs; 0: each as wide as brings it `crossings`, up to `most`
  float most = 0;                   // m; 0: a fiftieth of the scene's radius
  double crossings = 4000;
  OriginSet origins = kAllOrigins;
  std::uint64_t seed = 1;
};

struct PathReadings {
  std::vector<Reading> readings;
  std::vector<float> radii;  // m, one a meter
};

/// Readings by photon paths through discs around the meters: all light, caustics too. docs/pipeline.md (meters.2) The interval is that of kReplicates independent batches, and wider by what the inner half of the disc
/// says of the radius's bias; where no path came, up to what three paths would have brought. The same numbers for any
/// number of threads. Requires: emitters. Cost: see add_batch().
PathReadings measure_by_paths(const World& world, std::span<const Meter> meters, const PathMeterSettings& settings,
                              const Progress& progress = {});

}  // namespace radfarm
