#include "image/tone_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/rgb.h"

namespace radfarm {
namespace {

/// Of the base-2 logarithms of all luminances above 0.
float exposure_of(std::vector<double> logarithms) {
  if (logarithms.empty()) return 0;
  std::sort(logarithms.begin(), logarithms.end());
  const std::size_t trimmed = logarithms.size() / 20;
  double sum = 0;
  for (std::size_t i = trimmed; i < logarithms.size() - trimmed; ++i) sum += logarithms[i];
  return static_cast<float>(std::log2(0.18) - sum / static_cast<double>(logarithms.size() - 2 * trimmed));
}

}  // namespace

float auto_exposure(const Image& image) {
  const Result<RgbLayer> rgb = rgb_layer(image);
  if (!rgb) return 0;
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const double y = luminance(SpectrumD(rgb->at(i)));
    if (y > 0 && std::isfinite(y)) logarithms.push_back(std::log2(y));
  }
  return exposure_of(std::move(logarithms));
}

float auto_exposure(std::span<const float> luminances) {
  std::vector<double> logarithms;
  for (const float y : luminances) {
    if (y > 0 && std::isfinite(y)) logarithms.push_back(std::log2(static_cast<double>(y)));
  }
  return exposure_of(std::move(logarithms));
}

float srgb_from_linear(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

}  // namespace radfarm
