#include "radiosity/oracles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radfarm {
namespace {

/// A kernel is finite and not negative; what is not so is no light.
double kernel_of(float sample) {
  return sample > 0 && sample <= std::numeric_limits<float>::max() ? static_cast<double>(sample) : 0;
}

double sum_of(std::span<const float> samples) {
  double sum = 0;
  for (const float f : samples) sum += kernel_of(f);
  return sum;
}

double mean_of(std::span<const float> samples) {
  return samples.empty() ? 0 : sum_of(samples) / static_cast<double>(samples.size());
}

/// (1/N) sum term(d_k), d_k = F_k / mean F - 1 >= -1.
template <typename Term>
double mean_over_deviations(std::span<const float> samples, const Term& term) {
  const double sum = sum_of(samples);
  if (!(sum > 0)) return 0;
  const auto count = static_cast<double>(samples.size());
  double total = 0;
  for (const float f : samples) total += term(std::max(-1.0, kernel_of(f) * count / sum - 1));
  return std::fmax(0, total / count);
}

double largest_deviation(std::span<const float> samples) {
  const double mean = mean_of(samples);
  double largest = 0;
  for (const float f : samples) largest = std::max(largest, std::fabs(kernel_of(f) - mean));
  return largest;
}

/// sum of term(p_k), p_k = F_k / sum F, times sum F.
template <typename Term>
double literal_divergence(std::span<const float> samples, const Term& term) {
  const double sum = sum_of(samples);
  if (!(sum > 0)) return 0;
  double total = 0;
  for (const float f : samples) total += term(kernel_of(f) / sum);
  return sum * total;
}

}  // namespace

double kl_divergence(std::span<const float> samples) {
  // r ln r - (r - 1) = (1 + d) log1p(d) - d loses no digits near r = 1; its limit at r = 0 is 1.
  return mean_over_deviations(samples, [](double d) { return d > -1 ? (1 + d) * std::log1p(d) - d : 1; });
}

double chi_square_divergence(std::span<const float> samples) {
  return mean_over_deviations(samples, [](double d) { return d * d; });
}

double hellinger_divergence(std::span<const float> samples) {
  // sqrt r - 1 = d / (sqrt r + 1) loses no digits near r = 1.
  return 0.5 * mean_over_deviations(samples, [](double d) {
           const double root = d / (std::sqrt(1 + d) + 1);
           return root * root;
         });
}

double misplaced_kernel(Oracle oracle, std::span<const float> samples) {
  switch (oracle) {
    case Oracle::kKs: return largest_deviation(samples);
    case Oracle::kKl: return mean_of(samples) * kl_divergence(samples);
    case Oracle::kCs: return mean_of(samples) * chi_square_divergence(samples) / 2;
    case Oracle::kHe: return mean_of(samples) * hellinger_divergence(samples) * 4;
    case Oracle::kVar: return mean_of(samples) * std::sqrt(chi_square_divergence(samples));
  }
  return 0;
}

double literal_kernel(Oracle oracle, std::span<const float> samples, double receiver_area) {
  const double q = 1 / static_cast<double>(std::max<std::size_t>(1, samples.size()));
  switch (oracle) {
    case Oracle::kKs: return largest_deviation(samples) / receiver_area;
    case Oracle::kKl: return literal_divergence(samples, [&](double p) { return p > 0 ? p * std::log(p / q) : 0; });
    case Oracle::kCs: return literal_divergence(samples, [&](double p) { return (p - q) * (p - q) / q; });
    case Oracle::kHe:
      return literal_divergence(samples, [&](double p) { return 0.5 * std::pow(std::sqrt(p) - std::sqrt(q), 2); });
    case Oracle::kVar: {  // F^2 V, V = avg(p^2) - q^2 = avg(p^2 - q^2)
      return sum_of(samples) * q * literal_divergence(samples, [&](double p) { return p * p - q * q; });
    }
  }
  return 0;
}

}  // namespace radfarm
