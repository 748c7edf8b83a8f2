#pragma once

#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/radiance_parts.h"
#include "scene/world.h"

namespace radfarm {

/// Unbiased path tracing: the truth that every other integrator is held to.          docs/pipeline.md (path.1), [Kaj86]
///
/// Next-event estimation towards all emitters, combined with the paths that hit one by the balance heuristic (path.2);
/// triangles are sampled by solid angle where it is large enough to pay, else by area. From the third bounce on a
/// path survives with probability lum(w rho) / lum(w), at most 0.99, so every path ends. No bound on depth.
/// Requires: `ray` unit. Cost: about 2 rays a bounce.
RadianceParts trace_path(const World& world, const Ray& ray, const PixelSampler& sampler, Counters& counters);

}  // namespace radfarm
