#pragma once

#include <cstdint>

#include "estimate/gather_context.h"

namespace radfarm {

/// Irradiance, lux, that surfaces closer than point.near_distance reflect to the point, by `rays` cosine-distributed rays of that
/// length (gather.4): a grid vertex knows little of what is nearer than its cells are wide, and however small and near a surface is,
/// a ray meets it as often as it fills the view. Emitters are left to the senders. Uses `rays` random dimensions from `dimension`.
Spectrum near_light(const GatherPoint& point, std::uint32_t rays, std::uint32_t dimension);

}  // namespace radfarm
