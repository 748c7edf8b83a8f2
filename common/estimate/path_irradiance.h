#pragma once

#include "estimate/counters.h"
#include "estimate/diffuse_light.h"
#include "estimate/pixel_sampler.h"
#include "scene/world.h"

namespace radfarm {

/// Irradiance at a point, lux, by one path: an emitter sampled, and what a cosine-distributed ray sees reflected, by
/// trace_path(). Unbiased, but for what no path meets: light of points and directions by mirrors and clear glass.
/// `onward` must share no number with `sampler`. Cost: some 5 rays.
Arrived path_irradiance(const World& world, const SurfacePoint& point, const PixelSampler& sampler,
                        const PixelSampler& onward, Counters& counters);

}  // namespace radfarm
