#pragma once

#include <cstdint>

#include "estimate/pixel_sums.h"

namespace radfarm {

/// How many samples pixels get.                                                              docs/pipeline.md (pixels.1)
struct SampleBudget {
  std::uint32_t first = 1;  // each pixel
  std::uint32_t most = 1;   // any pixel, at scale 1
  float noise = 0;          // cd/m^2: a pixel whose samples scatter by s gets s / noise; 0: `first`
  double scale = 1;         // at least 1: of `most` and of what a pixel gets, above its first samples
};

/// What decides a pixel's samples, by its neighbours' first ones, and its samples that looked for emission alone. Resumable,
/// stored as it is (docs/formats.md); no padding.
struct PixelNeeds {
  double light = 0;                  // cd/m^2: how much samples scatter that its light needs
  double emission = 0;               // cd/m^2: the same of the emission seen directly
  SpectrumD emission_sum;
  std::uint32_t emission_taken = 0;  // kept and dropped
  std::uint32_t emission_kept = 0;
  friend bool operator==(const PixelNeeds&, const PixelNeeds&) = default;
};
static_assert(sizeof(PixelNeeds) == 5 * sizeof(double) + 2 * sizeof(std::uint32_t), "PixelNeeds has padding");

/// Whether all pixels get the same.
inline bool is_even(const SampleBudget& budget) { return !(budget.noise > 0) || budget.most <= budget.first; }

/// Camera samples of a pixel in all; with an even budget `needs` does not matter. Never falls as the scale grows.
std::uint32_t samples_of(const SampleBudget& budget, const PixelNeeds& needs);

/// Samples of its emission alone, beside these.
std::uint32_t emission_samples_of(const SampleBudget& budget, const PixelNeeds& needs);

/// Puts what samples of the emission alone found into a pixel's sums, as if all its samples had.
void complete_emission(const PixelNeeds& needs, PixelSums& pixel);

}  // namespace radfarm
