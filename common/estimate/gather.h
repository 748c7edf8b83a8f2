#pragma once

#include "estimate/first_surface.h"
#include "estimate/gather_context.h"
#include "estimate/radiance_parts.h"

namespace radfarm {

/// Grid final gather: the light at a visible point from the senders of a grid vertex around it.   docs/pipeline.md (gather.1)
///
/// The vertex is chosen by the point's interpolation weights, one a camera sample, so that the mean over a pixel is the
/// conforming interpolation and the blend of mixed classifications, continuous from cell to cell. Interpolated senders
/// add their lobes; of the critical ones `samples_per_gather` are drawn by systematic sampling in proportion to what
/// they are likely to give the point: the form factor of a patch is exact, its visibility traced. What is nearer than a
/// grid cell is wide comes by rays (reflected_light.h), the sky's light by sky_light.h. Punctual lights are always traced.
/// What gloss, mirrors and glass show is followed by rays (the eye chain); where they end on diffuse surfaces, which may be
/// outside the grid, the light is a next event's and the radiosity solution's where one more ray ends. Fills `first` where given.
RadianceParts gather_radiance(const GatherContext& context, const Ray& ray, const PixelSampler& sampler,
                              Counters& counters, FirstSurface* first = nullptr);

/// The emission alone that gather_radiance() finds as seen directly.
Spectrum gather_emission(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters);

}  // namespace radfarm
