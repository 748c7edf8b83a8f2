#pragma once

#include <cstdint>

#include "estimate/gather_context.h"

namespace radfarm {

/// The reflector that a ray met; nullptr where nothing is reflected. Requires: `met` is face()d.
const Reflector* reflector_at(const GatherContext& context, const Hit& hit, const SurfacePoint& met);

/// The radiance of a reflector seen along `way`. Where next events are on, what it has straight from emitters is sampled at the
/// very point: who looks at a patch looks at its lit part, and its mean is too dark for that. What a doubtful one has from surfaces
/// comes by one more ray, at most 4 after each other; this is the `rays`th. Uses 2 random dimensions from `dimension`, and some
/// far off.                                                                                  docs/pipeline.md (gather.4)
Spectrum radiance_at(const GatherPoint& point, const Reflector& reflector, const SurfacePoint& met, const Vec3& way,
                     std::uint32_t dimension, std::uint32_t rays = 1);

/// That radiance at a line's end against the mean of its patch; 1 where next events are off or the patch reflects nothing.
Spectrum reflected_ratio(const GatherPoint& point, const SenderSample& end, std::uint32_t dimension);

}  // namespace radfarm
