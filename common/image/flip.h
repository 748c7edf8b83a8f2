#pragma once

#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

/// How different two images look when one flips between them, by pixel: 0 the same, 1 as far as black from white.
struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> values;  // row by row
  double mean = 0;
};

/// Pixels of a display that fill a degree: 0.7 m from a 0.7 m wide 4K monitor, as in [Andersson et al. 2020].
inline constexpr float kPixelsPerDegree = 67.02F;

/// FLIP of [Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: FLIP: A Difference Evaluator for Alternating
/// Images, HPG 2020]: colour after the eye's contrast sensitivity (HyAB with Hunt's adjustment), strengthened where edges
/// and points differ. Both images are shown as encode_png() shows them at `exposure_ev`: sRGB, clamped.
/// INVALID_ARGUMENT when the sizes differ or one has no R, G, B. O(pixels), about 1 us each; 60 bytes a pixel.
Result<FlipMap> flip(const Image& image, const Image& reference, float exposure_ev,
                     float pixels_per_degree = kPixelsPerDegree);

}  // namespace radfarm
