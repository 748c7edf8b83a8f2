#pragma once

#include <functional>

#include "estimate/diffuse_light.h"
#include "estimate/first_surface.h"
#include "estimate/radiance_parts.h"

namespace radfarm {

/// Told of each diffuse surface that a camera ray sees, and how much of its irradiance, lux, reaches the camera as radiance.
using SeeReceiver = std::function<void(const Hit&, const SurfacePoint&, const Spectrum& weight)>;

/// What the chains of a view borrow.
struct EyeChainContext {
  const World& world;
  const DiffuseLight& light;
  bool has_interreflection = true;  // off: `indirect` is not returned
  FirstSurface* first = nullptr;    // filled where given, but for what is of the grid
  const SeeReceiver* receivers = nullptr;
};

/// sampler.key() of what decides, at holes, which surface the camera sees first.
inline constexpr std::uint32_t kCoverageDimension = 1;

/// What a camera ray sees, by panes, mirrors, glass and gloss too: each diffuse surface on the way gets its light from
/// `context.light`; what is specular is followed by rays.                                  docs/pipeline.md (gather.6)
RadianceParts trace_eye_chain(const EyeChainContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                              Counters& counters);

/// The emission alone of what trace_eye_chain() sees by no surface but panes: what a camera ray costs.
Spectrum seen_emission(const EyeChainContext& context, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters);

}  // namespace radfarm
