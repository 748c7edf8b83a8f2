#pragma once

#include "estimate/first_surface.h"
#include "estimate/gather_context.h"
#include "estimate/radiance_parts.h"

namespace radfarm {

/// Final gather as Scheel, Stamminger and Seidel have it [1]: the lists of all four vertices of the point's tetrahedron, or of
/// the three of its patch where radiosity went down to patches, are blended by their weights; a critical sender is evaluated at an
/// interpolated, real number of sample points that are the same over the whole image. docs/pipeline.md (paper.5) to (paper.9)
/// No rays to reflectors, no systematic sampling: biased, where the default gather is noisy. The yardstick, not the product.
/// Requires: a grid classified for Gather::kPaper. Cost: as many rays as the vertices ask for, some hundred.
RadianceParts paper_gather_radiance(const GatherContext& context, const Ray& ray, const PixelSampler& sampler,
                                    Counters& counters, FirstSurface* first = nullptr);

}  // namespace radfarm
