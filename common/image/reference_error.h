#pragma once

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

/// How far an image is from a reference in two independent halves, whose own noise cancels: reflected luminance (R, G, B less
/// emission, where the images have that layer), cd/m^2.
struct ReferenceError {
  double mse = 0;                // mean of (x - a)(x - b); may be below 0 within its noise
  double relative = 0;           // sqrt(max(mse, 0)) / mean
  double relative_low = 0;       // 95 %, over blocks of 16 x 16 pixels
  double relative_high = 0;
  double ratio_of_means = 1;     // of the image's to the reference's; 1 when both are black
  double mean = 0;               // of the reference
  double reference_relative = 0; // the halves' own: sqrt(mean (a - b)^2 / 4) / mean, what the mean of both is off by noise
};

/// Pixels that are not finite in any of the three enter no mean. INVALID_ARGUMENT when sizes differ or one has no R, G, B, or
/// no pixel is left.
Result<ReferenceError> reference_error(const Image& image, const Image& half_a, const Image& half_b);

}  // namespace radfarm
