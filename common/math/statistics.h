#pragma once

#include <cstdint>

namespace radfarm {

/// Mean and variance of numbers that come one at a time, without cancellation. [Welford 1962; Chan et al. 1983 to merge]
class RunningStatistics {
 public:
  void add(double value);
  /// As if the other's numbers had been added here. Equal up to rounding in any order, so merge in index order.
  void merge(const RunningStatistics& other);

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased (divides by count - 1); 0 for fewer than two numbers.
  double variance() const { return count_ < 2 ? 0.0 : sum_of_squares_ / static_cast<double>(count_ - 1); }
  double standard_deviation() const;
  /// Standard deviation of the mean.
  double standard_error() const;

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0;
  double sum_of_squares_ = 0;  // of deviations from the mean
};

/// P(X < x) of the standard normal distribution.
double normal_cdf(double x);
/// x with normal_cdf(x) = p, to 1e-15 relative or absolute; -inf and +inf at 0 and 1.
double normal_quantile(double p);

/// P(T < t) of Student's distribution. Requires: degrees_of_freedom >= 1. O(degrees of freedom), normal above 1e5.
double student_t_cdf(double t, int degrees_of_freedom);
/// t with student_t_cdf(t, degrees_of_freedom) = p: the factor of the standard error in a confidence interval.
double student_t_quantile(double p, int degrees_of_freedom);

}  // namespace radfarm
