#include "image/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "image/rgb.h"

namespace radfarm {
namespace {

/// x / y, with 0 / 0 = `both_zero`.
double ratio(double x, double y, double both_zero) {
  if (y != 0) return x / y;
  return x == 0 ? both_zero : std::numeric_limits<double>::infinity();
}

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

/// Sums over the pixels that are finite in both images.
struct Sums {
  SpectrumD a, b, squared_difference;
  double squared_luminance_difference = 0;
};

/// Adds one pixel to the sums; false when it is not finite.
bool add_pixel(const SpectrumD& a, const SpectrumD& b, Sums& sums, Comparison& result) {
  if (!is_finite(a) || !is_finite(b)) return false;
  const SpectrumD difference = a - b;
  const double dy = luminance(difference);
  sums.a += a;
  sums.b += b;
  sums.squared_difference += difference * difference;
  sums.squared_luminance_difference += dy * dy;
  const double largest = std::max({std::fabs(difference.r), std::fabs(difference.g), std::fabs(difference.b)});
  result.max_difference = std::max(result.max_difference, largest);
  return true;
}

/// Mean of the squared difference relative to the reference, which a hundredth of its mean keeps off zero.
double relative_mean_squared_error(const RgbLayer& a, const RgbLayer& b, const Comparison& result) {
  const double floor = 0.01 * result.mean_b * result.mean_b;
  double sum = 0;
  for (std::size_t i = 0; i < a.r.size(); ++i) {
    if (!is_finite(a.at(i)) || !is_finite(b.at(i))) continue;
    const double ya = luminance(SpectrumD(a.at(i)));
    const double yb = luminance(SpectrumD(b.at(i)));
    sum += ratio((ya - yb) * (ya - yb), yb * yb + floor, 0);
  }
  return sum / static_cast<double>(result.pixels);
}

/// Fills in all but the share, which is the region's sum of squares: returned.
double add_region(const RgbLayer& a, const RgbLayer& b, int width, RegionError& region) {
  double sum_a = 0, sum_b = 0, squares = 0, count = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (!is_finite(a.at(i)) || !is_finite(b.at(i))) continue;
      const double ya = luminance(SpectrumD(a.at(i))), yb = luminance(SpectrumD(b.at(i)));
      sum_a += ya, sum_b += yb, squares += (ya - yb) * (ya - yb), count += 1;
    }
  }
  region.rmse = count > 0 ? std::sqrt(squares / count) : 0;
  region.relative_rmse = count > 0 ? ratio(region.rmse, sum_b / count, 0) : 0;
  region.ratio_of_means = ratio(sum_a, sum_b, 1);
  region.share = squares;
  return squares;
}

}  // namespace

Result<Comparison> compare(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) {
    return fail(Code::kInvalidArgument, "images differ in size: " + size_text(a) + " and " + size_text(b));
  }
  RADFARM_TRY(const RgbLayer rgb_a, rgb_layer(a));
  RADFARM_TRY(const RgbLayer rgb_b, rgb_layer(b));
  Comparison result;
  Sums sums;
  for (std::size_t i = 0; i < a.pixel_count(); ++i) {
    const bool added = add_pixel(SpectrumD(rgb_a.at(i)), SpectrumD(rgb_b.at(i)), sums, result);
    ++(added ? result.pixels : result.not_finite);
  }
  if (result.pixels == 0) return fail(Code::kInvalidArgument, "images have no pixel that is finite in both");

  const auto n = static_cast<double>(result.pixels);
  const SpectrumD& squares = sums.squared_difference;
  result.mean_a = luminance(sums.a) / n;
  result.mean_b = luminance(sums.b) / n;
  result.rmse = std::sqrt(sums.squared_luminance_difference / n);
  result.relative_rmse = ratio(result.rmse, result.mean_b, 0);
  result.ratio_of_means = ratio(result.mean_a, result.mean_b, 1);
  result.channel_rmse = {std::sqrt(squares.r / n), std::sqrt(squares.g / n), std::sqrt(squares.b / n)};
  result.channel_mean_ratio = {ratio(sums.a.r, sums.b.r, 1), ratio(sums.a.g, sums.b.g, 1), ratio(sums.a.b, sums.b.b, 1)};
  result.relmse = relative_mean_squared_error(rgb_a, rgb_b, result);
  return result;
}

Result<std::vector<RegionError>> compare_regions(const Image& a, const Image& b, int columns, int rows) {
  RADFARM_TRY_STATUS(compare(a, b));
  if (columns < 1 || rows < 1 || columns > a.width || rows > a.height) {
    return fail(Code::kInvalidArgument, std::to_string(columns) + "x" + std::to_string(rows) + " regions of an image of " +
                                            size_text(a) + ": at least 1, at most a region a pixel");
  }
  RADFARM_TRY(const RgbLayer rgb_a, rgb_layer(a));
  RADFARM_TRY(const RgbLayer rgb_b, rgb_layer(b));
  std::vector<RegionError> regions;
  double all = 0;
  for (int k = 0; k < columns * rows; ++k) {
    const int column = k % columns, row = k / columns;
    RegionError region{a.width * column / columns, a.height * row / rows, a.width * (column + 1) / columns,
                       a.height * (row + 1) / rows, 0, 0, 1, 0};
    all += add_region(rgb_a, rgb_b, a.width, region);
    regions.push_back(region);
  }
  for (RegionError& region : regions) region.share = all > 0 ? region.share / all : 0;
  return regions;
}

}  // namespace radfarm
