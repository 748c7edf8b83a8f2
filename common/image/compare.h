#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

/// How far image a is from image b, the reference. Luminance (cd/m^2) unless it says channel. A pixel that is not finite in
/// either image enters no mean; it is counted.
struct Comparison {
  double rmse = 0;                              // root of the mean squared difference
  double relative_rmse = 0;                     // rmse / mean_b; 0 when both images are black, infinite when only b is
  double relmse = 0;                            // mean of (a - b)^2 / (b^2 + 0.01 mean_b^2); 0 and infinite likewise
  double ratio_of_means = 1;                    // mean_a / mean_b; 1 when both are black
  double max_difference = 0;                    // largest |a - b| of any channel
  double mean_a = 0;
  double mean_b = 0;
  std::array<double, 3> channel_rmse{};         // R, G, B
  std::array<double, 3> channel_mean_ratio{};   // mean of a / mean of b
  std::size_t pixels = 0;                       // finite in both
  std::size_t not_finite = 0;
};

/// INVALID_ARGUMENT when the sizes differ or one has no R, G, B.
Result<Comparison> compare(const Image& a, const Image& b);

/// A part of an image: pixels [x0, x1) x [y0, y1), how far it is from the reference, and its share of all squared error.
struct RegionError {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double rmse = 0;           // of luminance
  double relative_rmse = 0;  // of the reference's mean there; 0 and infinite as in Comparison
  double ratio_of_means = 1;
  double share = 0;
};

/// The image in columns x rows parts of about the same size, row by row; pixels that are not finite enter none. Errors as
/// compare(), and INVALID_ARGUMENT unless there are 1 to width columns and 1 to height rows.
Result<std::vector<RegionError>> compare_regions(const Image& a, const Image& b, int columns, int rows);

}  // namespace radfarm
