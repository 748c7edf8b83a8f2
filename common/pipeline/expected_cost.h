#pragma once

#include "estimate/settings.h"
#include "scene/world.h"

namespace radfarm {

/// What a few thousand unbiased paths tell of a view before it is rendered.
struct PathPilot {
  double sample_seconds = 0;   // of one path, CPU seconds of this machine
  double ray_seconds = 0;      // of one of its rays with all that is done at its end
  double rays = 0;             // of one path
  double mean = 0;             // of reflected luminance, cd/m^2
  double path_variance = 0;    // (cd/m^2)^2, of one path by a pixel
};

/// Costs about 0.1 CPU s. All but the seconds depend on the arguments alone.
PathPilot trace_pilot(const World& world, const Camera& camera, const Settings& settings);

/// What a render is likely to cost, CPU seconds of this machine.
struct ExpectedCost {
  double low = 0;
  double high = 0;
  double audit = 0;    // of `low` and `high`: the audit's share, known best
  double prepare = 0;  // of `low` and `high`, very roughly: what comes before tasks
};

/// Scales the pilot's time by the settings' counts; what gathering adds is by the counts of rays and rough costs, chosen so that
/// cornell and office of docs/benchmarks.md lie within. `noise_share`: of the mean radiance, what pixels may keep of noise; 0:
/// all get the settings' first samples.
ExpectedCost expect_cost(const World& world, const Settings& settings, const PathPilot& pilot, float noise_share);

/// A pilot with the same counts and seconds as of a machine on which a ray takes half a microsecond: what must not depend on
/// the machine goes by this.
PathPilot nominal(const PathPilot& pilot);

}  // namespace radfarm
