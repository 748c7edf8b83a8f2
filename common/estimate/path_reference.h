#pragma once

#include "estimate/counters.h"
#include "estimate/first_surface.h"
#include "estimate/pixel_sampler.h"
#include "estimate/radiance_parts.h"
#include "scene/world.h"

namespace radfarm {

/// Unbiased path tracing: the truth that every other integrator is held to.          docs/pipeline.md (path.1), [Kaj86]
///
/// Next-event estimation towards all emitters and the sky, combined with the paths that hit one by the balance heuristic
/// (path.2), the diffuse and the specular part of each surface apart, so that light keeps its class; triangles are sampled by
/// solid angle where it is large enough to pay, else by area. From the third bounce on a path survives in proportion to what
/// its luminance keeps, at most 0.99, so every path ends. No bound on depth. It cannot carry the light of points and directions
/// by mirrors and clear glass: no ray finds either.
/// A ray with a cone sees textures filtered, which is not quite unbiased (docs/materials.md); the audit's rays are lines.
/// Requires: `ray` unit. Cost: about 2 rays a bounce.
/// Without `has_interreflection`, `indirect` and light that comes to the receiver by specular surfaces are left out.
/// Fills `first` where given; the irradiance is what one path brings, so it is noisy where albedo is small, and 0 where that is.
RadianceParts trace_path(const World& world, const Ray& ray, const PixelSampler& sampler, Counters& counters,
                         bool has_interreflection = true, FirstSurface* first = nullptr);

}  // namespace radfarm
