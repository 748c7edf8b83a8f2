#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/status.h"
#include "estimate/settings.h"
#include "estimate/task_result.h"
#include "frame/assemble.h"
#include "frame/round.h"

namespace radfarm {

/// A measured error with its 95 % interval. Without `value` the measurement lies below what it can resolve: it is < upper.
struct MeasuredError {
  std::optional<double> value;
  double lower = 0;
  double upper = 0;
};

/// How far the image is from the truth: luminance of reflected light, box filter of one pixel.
struct Accuracy {
  std::uint32_t audited_pixels = 0;
  double mean = 0;                      // of reflected luminance over the image, cd/m^2
  std::optional<MeasuredError> rmse;    // cd/m^2; nothing for a black image or without audit
  std::optional<MeasuredError> relative_rmse;
  std::array<double, 3> channel_mse{};  // R, G, B; may be negative within its noise
  double direct_mse = 0;                // parts that add up to the MSE
  double indirect_mse = 0;
  double specular_mse = 0;
  static constexpr int kMapColumns = 8, kMapRows = 6;
  std::array<double, kMapColumns * kMapRows> map_mse{};  // by part of the image, row by row; add up to the MSE, single ones may be negative
  // What the decision whether to render on goes by:
  double mse = 0;                       // may be negative within its noise, (cd/m^2)^2
  double mse_error = 0;                 // its standard error
  double audit_noise = 0;               // of that, what the audit's own paths bring, and not the choice of pixels
  double path_variance = 0;             // of the reflected luminance of one path by a pixel, mean over the image
  std::optional<double> surely_below;   // the relative error is below this but for a chance of 5 % / kMostRounds
};

/// Two independent unbiased estimates r1, r2 of each audited pixel estimate the image's MSE without bias, whatever the bias
/// of the image x: E (x - r1)(x - r2) = (x - r)^2.                            docs/accuracy.md (audit.1)
///
/// The interval is the percentile bootstrap over audited pixels (1000 resamples, keyed by the audit's seed).
/// Requires: audits in task order. DATA_LOSS when they are not the pixels that the round chooses. O(1000 m).
Result<Accuracy> audit(const Settings& settings, const Round& round, const Raster& raster, std::span<const AuditResult> audits);

}  // namespace radfarm
