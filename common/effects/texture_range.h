#pragma once

#include "scene/scene.h"

namespace radfarm {

/// What a texture's texels span.
struct TextureRange {
  Spectrum mean;               // linear
  Spectrum deviation;          // largest |texel - mean| of each channel
  float color_deviation = 0;   // largest relative deviation of a texel's channel from its luminance
  float least_alpha = 1;
};
/// O(texels).
TextureRange range_of(const Texture& texture);

/// The largest angle between a normal map's texels and the surface's normal, degrees. O(texels).
float largest_angle(const Texture& map, float scale);

}  // namespace radfarm
