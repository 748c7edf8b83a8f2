#pragma once

#include <array>
#include <cstddef>

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

}  // namespace radfarm
