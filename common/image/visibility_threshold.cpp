#include "image/visibility_threshold.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"

namespace radfarm {
namespace {

constexpr double kLeastLuminance = 1e-5;             // cd/m^2
constexpr double kLeastFrequency = 0.1, kMostFrequency = 60;  // cycles per degree
constexpr double kBrightField = 100;                 // cd/m^2, at which the peak of the sensitivity is taken
constexpr double kPeakFrequency = 3.248;             // cycles per degree, there
constexpr int kLevels = 8;                           // of the pyramid
constexpr int kBands = kLevels - 2;
constexpr double kLeastPattern = 1;                  // cycles per degree: what is coarser is shading, and hides no shadow
constexpr double kLeastContrast = 0.1;               // of the threshold: what is less is rounding, no pattern
// B-spline taps of the pyramid [Burt, Adelson 1983, a = 0.4], 2^level pixels apart.
constexpr double kTaps[] = {0.05, 0.25, 0.4, 0.25, 0.05};

using Plane = std::vector<float>;

/// One level coarser. The image goes on beyond its border as its last pixel.
Plane blur_along(const LuminanceImage& size, const Plane& plane, int step, bool is_across) {
  Plane out(plane.size());
  const auto place = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
  };
  parallel_for(static_cast<std::size_t>(size.height), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < size.width; ++x) {
        double sum = 0;
        for (int t = -2; t <= 2; ++t) {
          const int px = is_across ? std::clamp(x + t * step, 0, size.width - 1) : x;
          const int py = is_across ? y : std::clamp(y + t * step, 0, size.height - 1);
          sum += kTaps[t + 2] * static_cast<double>(plane[place(px, py)]);
        }
        out[place(x, y)] = static_cast<float>(sum);
      }
    }
  });
  return out;
}

std::vector<Plane> make_pyramid(const LuminanceImage& image) {
  std::vector<Plane> levels{Plane(image.values.size())};
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float value = image.values[i];
    levels[0][i] = std::isfinite(value) ? std::max(0.0F, value) : 0;
  }
  for (int level = 1; level < kLevels; ++level) {
    const int step = 1 << (level - 1);
    levels.push_back(blur_along(image, blur_along(image, levels.back(), step, true), step, false));
  }
  return levels;
}

/// The level whose pixels are about a degree wide.
int level_of_degree(double pixels_per_degree) {
  return std::clamp(static_cast<int>(std::lround(std::log2(std::max(1.0, pixels_per_degree)))), 0, kLevels - 1);
}

/// Per band: its frequency, and how much less visible it is than the most visible one.
struct Band {
  double frequency = 0;
  double elevation = 1;
};
std::vector<Band> make_bands(double pixels_per_degree) {
  std::vector<Band> bands;
  const double peak = contrast_sensitivity(kPeakFrequency, kBrightField);
  for (int i = 0; i < kBands; ++i) {
    const double frequency = pixels_per_degree / 2 / (1 << i);
    if (frequency < kLeastPattern) break;
    bands.push_back({frequency, std::max(1.0, peak / contrast_sensitivity(frequency, kBrightField))});
  }
  return bands;
}

/// (masking.4) at one pixel, before it is clamped.
double elevation_at(const std::vector<Plane>& levels, const std::vector<Band>& bands, std::size_t pixel, double adaptation) {
  double sum = 0, weighed = 0;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const auto at = [&](std::size_t level) { return static_cast<double>(levels[level][pixel]); };
    const double contrast = std::fabs(at(i) - at(i + 1)) / std::max(at(i + 2), kLeastLuminance);
    const double normalised = contrast * contrast_sensitivity(bands[i].frequency, adaptation);
    if (normalised < kLeastContrast) continue;
    sum += contrast;
    weighed += contrast * bands[i].elevation * masking_by(normalised);
  }
  return sum > 0 ? weighed / sum : 1;
}

}  // namespace

double visible_difference(double luminance) {
  const double l = std::log10(std::max(luminance, kLeastLuminance));
  const auto rods = [](double x) { return std::pow(0.405 * x + 1.6, 2.18) - 2.86; };
  const auto cones = [](double x) { return std::pow(0.249 * x + 0.65, 2.7) - 0.72; };
  // At -1.44 and 1.9 the next branch starts 2.7 % and 0.7 % lower: it waits until it has caught up.
  if (l < -3.94) return std::pow(10, -2.86);
  if (l < -1.44) return std::pow(10, std::max(-2.86, rods(l)));
  if (l < -0.0184) return std::pow(10, std::max(l - 0.395, rods(-1.44)));
  if (l < 1.9) return std::pow(10, std::max(cones(l), -0.0184 - 0.395));
  return std::pow(10, std::max(l - 1.255, cones(1.9)));
}

double contrast_sensitivity(double cycles_per_degree, double luminance) {
  const double c = std::clamp(cycles_per_degree, kLeastFrequency, kMostFrequency);
  const double l = std::max(luminance, kLeastLuminance);
  const double a = 440 * std::pow(1 + 0.7 / l, -0.2), b = 0.3 * std::pow(1 + 100 / l, 0.15);
  return a * c * std::exp(-b * c) * std::sqrt(1 + 0.06 * std::exp(b * c));
}

double masking_by(double normalised_contrast) {
  constexpr double kSlope = 0.7, kKnee = 4;
  const double k1 = std::pow(6.0, -7.0 / 3), k2 = std::pow(6.0, 10.0 / 3);
  return std::pow(1 + std::pow(k1 * std::pow(k2 * std::fabs(normalised_contrast), kSlope), kKnee), 1 / kKnee);
}

LuminanceImage displayed(const LuminanceImage& image, float exposure_ev) {
  LuminanceImage shown = image;
  const double scale = kDisplayWhite * std::exp2(static_cast<double>(exposure_ev));
  for (float& value : shown.values) value = static_cast<float>(std::min(kDisplayWhite, scale * static_cast<double>(value)));
  return shown;
}

Visibility judge_visibility(const LuminanceImage& shown, double pixels_per_degree, float max_elevation) {
  RADFARM_CHECK(max_elevation >= 1 && pixels_per_degree > 0);
  const std::vector<Plane> levels = make_pyramid(shown);
  const std::vector<Band> bands = make_bands(pixels_per_degree);
  Visibility result;
  result.adaptation = {shown.width, shown.height, levels[static_cast<std::size_t>(level_of_degree(pixels_per_degree))]};
  result.elevation = {shown.width, shown.height, Plane(shown.values.size())};
  parallel_for(shown.values.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double elevation = elevation_at(levels, bands, i, static_cast<double>(result.adaptation.values[i]));
      result.elevation.values[i] = static_cast<float>(std::clamp(elevation, 1.0, static_cast<double>(max_elevation)));
    }
  });
  return result;
}

double mean_of(const LuminanceImage& image) {
  double sum = 0;
  for (const float value : image.values) sum += static_cast<double>(value);
  return image.values.empty() ? 0 : sum / static_cast<double>(image.values.size());
}

}  // namespace radfarm
