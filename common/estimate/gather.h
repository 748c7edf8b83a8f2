#pragma once

#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/radiance_parts.h"
#include "scene/world.h"
#include "senders/sender_grid.h"

namespace radfarm {

/// Grid final gather: the light at a visible point from the senders of a grid vertex around it.   docs/pipeline.md (gather.1)
///
/// The vertex is chosen by the point's interpolation weights, one a camera sample, so that the mean over a pixel is the
/// conforming interpolation and the blend of mixed classifications, continuous from cell to cell. Interpolated senders
/// add their lobes; of the critical ones `samples_per_gather` are drawn by systematic sampling in proportion to their
/// unoccluded irradiance at the vertex: the form factor of a patch is exact, its visibility traced. Punctual lights are
/// always traced. Stops at the first surface: everything is Lambertian.
struct GatherContext {
  const World& world;
  const SenderTree& tree;
  const SenderGrid& senders;
  const SenderSettings& settings;
  bool has_interreflection = true;  // effect interreflection; off: `indirect` is neither computed nor returned
};
RadianceParts gather_radiance(const GatherContext& context, const Ray& ray, const PixelSampler& sampler,
                              Counters& counters);

}  // namespace radfarm
