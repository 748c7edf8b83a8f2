#pragma once

#include "estimate/settings.h"
#include "scene/world.h"

namespace radfarm {

/// What a render is likely to cost, CPU seconds of this machine.
struct ExpectedCost {
  double low = 0;
  double high = 0;
  double audit = 0;      // of `low` and `high`: the audit's share, known best
  double ray_seconds = 0;  // of one ray of a path with all that is done at its end, as measured
};

/// Traces a few thousand paths of the view and scales their time by the settings' counts; what gathering adds is by the counts
/// of rays and rough costs, chosen so that cornell and office of docs/benchmarks.md lie within. Costs about 0.1 CPU s.
ExpectedCost expect_cost(const World& world, const Camera& camera, const Settings& settings);

}  // namespace radfarm
