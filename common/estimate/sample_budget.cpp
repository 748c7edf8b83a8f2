#include "estimate/sample_budget.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

constexpr double kMostOfAll = 4e9;  // that a count can hold

/// A real number of samples for what scatters so much.
double wanted(const SampleBudget& budget, double scatter) {
  const double first = budget.first, most = std::min(kMostOfAll, budget.scale * budget.most);
  return std::clamp(budget.scale * (scatter / static_cast<double>(budget.noise)), first, std::max(first, most));
}

}  // namespace

std::uint32_t samples_of(const SampleBudget& budget, const PixelNeeds& needs) {
  if (!is_even(budget)) return static_cast<std::uint32_t>(std::ceil(wanted(budget, needs.light)));
  return std::max(budget.first, static_cast<std::uint32_t>(std::min(kMostOfAll, std::round(budget.first * budget.scale))));
}

std::uint32_t emission_samples_of(const SampleBudget& budget, const PixelNeeds& needs) {
  if (is_even(budget)) return 0;
  return static_cast<std::uint32_t>(std::ceil(std::max(0.0, wanted(budget, needs.emission) - wanted(budget, needs.light))));
}

void complete_emission(const PixelNeeds& needs, PixelSums& pixel) {
  const double kept = static_cast<double>(pixel.samples) + needs.emission_kept;
  if (needs.emission_kept > 0 && kept > 0) pixel.emission = (pixel.emission + needs.emission_sum) * (pixel.samples / kept);
}

}  // namespace radfarm
