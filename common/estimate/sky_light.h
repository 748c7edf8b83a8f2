#pragma once

#include <cstdint>
#include <span>

#include "estimate/gather_context.h"

namespace radfarm {

/// Irradiance from the environment at the point, lux (gather.5): `lines` directions, drawn by systematic sampling in proportion to
/// what each sky patch gives the point unoccluded times the share `seen` of it that a grid vertex saw. Each takes one visibility
/// ray. Uses the random dimensions from `dimension` to `dimension + lines`.
Spectrum sky_light(const GatherPoint& point, std::span<const float> seen, std::uint32_t lines, std::uint32_t dimension);

}  // namespace radfarm
