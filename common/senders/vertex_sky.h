#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/world.h"
#include "senders/receivers.h"

namespace radfarm {

/// The share of each sky patch that receivers around a grid vertex see (senders.6), by a few lines to each, with a doubt: what
/// none of them saw may be seen beside them. Empty without environment. Cost: 6 rays a patch.
std::vector<float> visible_sky(const World& world, std::span<const ReceiverPoint> receivers, std::uint64_t key);

}  // namespace radfarm
