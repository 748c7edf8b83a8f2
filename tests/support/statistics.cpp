#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/check.h"
#include "math/statistics.h"

namespace radfarm::test {
namespace {

constexpr double kLeastExpected = 5;

/// x^a e^-x / Gamma(a).
double gamma_prefix(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// P by its power series, for x < a + 1.
double gamma_series(double a, double x) {
  double term = 1 / a;
  double sum = term;
  for (double n = a + 1; term > sum * 1e-17; ++n) {
    term *= x / n;
    sum += term;
  }
  return sum * gamma_prefix(a, x);
}

/// Q by its continued fraction (modified Lentz), for x >= a + 1.
double gamma_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a;
  double c = 1 / kTiny;
  double d = 1 / b;
  double value = d;
  for (int i = 1; i < 100'000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    d = 1 / (std::fabs(d) < kTiny ? kTiny : d);
    c = b + an / c;
    if (std::fabs(c) < kTiny) c = kTiny;
    value *= c * d;
    if (std::fabs(c * d - 1) < 1e-16) break;
  }
  return value * gamma_prefix(a, x);
}

}  // namespace

double regularized_gamma_p(double a, double x) {
  RADFARM_CHECK(a > 0 && x >= 0);
  if (x == 0) return 0;
  return x < a + 1 ? gamma_series(a, x) : 1 - gamma_fraction(a, x);
}

double regularized_gamma_q(double a, double x) {
  RADFARM_CHECK(a > 0 && x >= 0);
  if (x == 0) return 1;
  return x < a + 1 ? 1 - gamma_series(a, x) : gamma_fraction(a, x);
}

ChiSquare chi_square(std::span<const double> observed, std::span<const double> expected) {
  RADFARM_CHECK(observed.size() == expected.size());
  const double observed_total = std::accumulate(observed.begin(), observed.end(), 0.0);
  const double expected_total = std::accumulate(expected.begin(), expected.end(), 0.0);
  ChiSquare result;
  if (std::fabs(observed_total - expected_total) > 0.5) return {.statistic = HUGE_VAL, .p_value = 0};

  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return expected[i] < expected[j]; });
  double pooled_observed = 0;
  double pooled_expected = 0;
  int cells = 0;
  for (const std::size_t i : order) {
    if (expected[i] <= 0 && observed[i] > 0) return {.statistic = HUGE_VAL, .p_value = 0};
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < kLeastExpected) continue;
    const double difference = pooled_observed - pooled_expected;
    result.statistic += difference * difference / pooled_expected;
    ++cells;
    pooled_observed = pooled_expected = 0;
  }
  result.degrees_of_freedom = std::max(cells - 1, 0);
  if (result.degrees_of_freedom > 0) {
    result.p_value = regularized_gamma_q(result.degrees_of_freedom / 2.0, result.statistic / 2);
  }
  return result;
}

double sidak_level(double family_level, std::size_t tests) {
  return -std::expm1(std::log1p(-family_level) / static_cast<double>(tests));
}

double z_test(double mean, double standard_error, double expected) {
  if (mean == expected) return 1;
  return standard_error > 0 ? 2 * normal_cdf(-std::fabs(mean - expected) / standard_error) : 0;
}

}  // namespace radfarm::test
