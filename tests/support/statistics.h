#pragma once

#include <cstddef>
#include <span>

namespace radfarm::test {

/// Pearson's test of counts against the counts that the hypothesis expects.
struct ChiSquare {
  double statistic = 0;
  int degrees_of_freedom = 0;  // pooled cells - 1
  double p_value = 1;          // chance of a statistic at least as large when the hypothesis is true
};

/// Cells are pooled, the smallest first, until each pool expects 5 counts, as the test's limit law needs. Counts
/// where exactly nothing is expected, or totals that differ by more than half a count, give p = 0: the pdf does not cover
/// the sampler, or does not integrate to 1.
/// Requires: equal sizes.
ChiSquare chi_square(std::span<const double> observed, std::span<const double> expected);

/// Level of each of `tests` independent tests that makes one false alarm among them happen with chance `family_level`.
double sidak_level(double family_level, std::size_t tests);

/// Two-sided p-value of a mean that should be `expected`, by the normal law. 1 when equal, 0 when the standard error is 0
/// and they differ.
double z_test(double mean, double standard_error, double expected);

/// P(a, x) = gamma(a, x) / Gamma(a) and Q = 1 - P, each without cancellation. Requires: a > 0, x >= 0. 1e-13 relative.
double regularized_gamma_p(double a, double x);
double regularized_gamma_q(double a, double x);

}  // namespace radfarm::test
