#include "radiosity/oracles.h"

#include <cmath>

namespace radfarm {

double kl_divergence(std::span<const float> samples) {
  double sum = 0;
  for (const float f : samples) sum += static_cast<double>(f);
  if (!(sum > 0)) return 0;
  const auto count = static_cast<double>(samples.size());
  double divergence = 0;
  for (const float f : samples) {
    // r ln r - (r - 1) = (1 + d) log1p(d) - d loses no digits near r = 1; its limit at r = 0 is 1.
    const double d = static_cast<double>(f) * count / sum - 1;
    divergence += d > -1 ? (1 + d) * std::log1p(d) - d : 1;
  }
  return std::fmax(0, divergence / count);
}

}  // namespace radfarm
