#pragma once

#include <span>
#include <vector>

#include "estimate/aov_sums.h"
#include "estimate/pixel_sums.h"
#include "estimate/sharing_sums.h"

namespace radfarm {

/// Replaces the direct and indirect light of each pixel by what it and its neighbours tell of it.   docs/pipeline.md (sharing.1)
///
/// The irradiance of a diffuse surface is fitted by a function linear in place and normal over pixels up to kShareRadius away
/// that look at a like surface and whose light is not seen to differ: by weights from one half of the samples for the light of
/// the other, so that no sample chooses its own weight. As samples grow fewer pixels are alike, and the result tends to the
/// pixel's own mean. Pixels that see emitters, or nothing diffuse, stay as they are; specular light and emission always do.
/// `pixels` and `sums` are row by row; `aovs`, too, or none: their irradiance changes as the light does. The same bits on any
/// number of threads. About 14 us and 200 bytes a pixel.
///
/// Returns the variance, (cd/m^2)^2, that noise leaves each pixel's mean reflected luminance: from how what the two halves tell
/// differs, where they share; else as if samples were independent. Of one pixel it says little; its mean over many is the
/// image's.
std::vector<float> share_light(int width, int height, std::span<const SharingSums> sums, std::span<PixelSums> pixels,
                 std::span<AovSums> aovs = {});

}  // namespace radfarm
