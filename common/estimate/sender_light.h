#pragma once

#include <cstdint>

#include "estimate/gather_context.h"

namespace radfarm {

/// All light of one critical sender at a point, its visibility by `count` lines (gather.3). A patch's form factor is exact; of a
/// cluster as many patches as it has lines are drawn for this very point, each with one line. Uses the random dimensions from
/// `dimension` to `dimension + 4 count`. Requires: count > 0.
Arrived light_of_sender(const GatherPoint& point, const CriticalSender& sender, std::uint32_t count, std::uint32_t dimension);

}  // namespace radfarm
