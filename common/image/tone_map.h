#pragma once

#include <span>

#include "image/image.h"

namespace radfarm {

/// Stops (powers of two) that bring the logarithmic mean of the luminance to middle grey, 0.18. Black pixels do not count,
/// nor do the darkest and the brightest twentieth of the rest, so that small emitters do not decide. 0 for an image that is
/// black or has no R, G, B. The same bits on every machine with the same libm. O(n log n).
float auto_exposure(const Image& image);
/// The same of luminances.
float auto_exposure(std::span<const float> luminances);

/// The sRGB curve [IEC 61966-2-1] of a linear value, clamped to [0, 1]; NaN gives 0.
float srgb_from_linear(float linear);

}  // namespace radfarm
