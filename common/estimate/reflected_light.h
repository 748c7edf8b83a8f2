#pragma once

#include <cstdint>

#include "estimate/gather_context.h"

namespace radfarm {

/// Irradiance, lux, that surfaces which are no senders reflect to the point, by `rays` cosine-distributed rays to the
/// radiosity solution (gather.4); where all are senders, that of surfaces closer than point.near_distance: a grid vertex
/// knows little of what is nearer than its cells are wide. However small and near a surface is, a ray meets it as often as
/// it fills the view. Emitters are left to the senders. Uses 4 `rays` random dimensions from `dimension`.
Spectrum reflected_light(const GatherPoint& point, std::uint32_t rays, std::uint32_t dimension);

}  // namespace radfarm
