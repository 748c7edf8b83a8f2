#include "math/statistics.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/check.h"

namespace radfarm {
namespace {

/// x >= 0 at which `upper_tail`, which falls from 1/2, is p. Bisection: slow, exact, and needs nothing but monotony.
template <typename Tail>
double inverse_upper_tail(double p, const Tail& upper_tail) {
  if (p <= 0) return std::numeric_limits<double>::infinity();
  double low = 0;
  double high = 1;
  while (upper_tail(high) > p && high < 1e300) high *= 2;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    (upper_tail(middle) > p ? low : high) = middle;
  }
}

constexpr int kNormalDegreesOfFreedom = 100'000;  // beyond, Student's quantiles differ from the normal's by < 1e-4

/// P(T > t), t >= 0, as the finite sums of Abramowitz and Stegun 26.7.3 and 26.7.4.
double student_upper_tail(double t, int degrees_of_freedom) {
  if (degrees_of_freedom > kNormalDegreesOfFreedom) return normal_cdf(-t);
  const double root = std::sqrt(static_cast<double>(degrees_of_freedom));
  const double angle = std::atan2(t, root);
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const bool odd = degrees_of_freedom % 2 != 0;
  double term = odd ? cosine : 1.0;
  double sum = 0;
  for (int k = odd ? 3 : 2; k <= degrees_of_freedom; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1) / k;
  }
  const double complement = std::atan2(root, t);  // pi/2 - angle, without cancellation
  if (odd) return std::numbers::inv_pi * (complement - sine * sum);
  return (1 - sine * sum) / 2;
}

}  // namespace

void RunningStatistics::add(double value) {
  ++count_;
  const double deviation = value - mean_;
  mean_ += deviation / static_cast<double>(count_);
  sum_of_squares_ += deviation * (value - mean_);
}

void RunningStatistics::merge(const RunningStatistics& other) {
  if (other.count_ == 0) return;
  const auto mine = static_cast<double>(count_);
  const auto others = static_cast<double>(other.count_);
  const double difference = other.mean_ - mean_;
  count_ += other.count_;
  const auto total = static_cast<double>(count_);
  mean_ += difference * (others / total);
  sum_of_squares_ += other.sum_of_squares_ + difference * difference * (mine * others / total);
}

double RunningStatistics::standard_deviation() const { return std::sqrt(variance()); }

double RunningStatistics::standard_error() const {
  return count_ == 0 ? 0.0 : std::sqrt(variance() / static_cast<double>(count_));
}

double normal_cdf(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

double normal_quantile(double p) {
  RADFARM_CHECK(p >= 0 && p <= 1);
  if (p == 0.5) return 0;
  const double x = inverse_upper_tail(std::fmin(p, 1 - p), [](double y) { return normal_cdf(-y); });
  return p < 0.5 ? -x : x;
}

double student_t_cdf(double t, int degrees_of_freedom) {
  RADFARM_CHECK(degrees_of_freedom >= 1);
  const double tail = student_upper_tail(std::fabs(t), degrees_of_freedom);
  return t < 0 ? tail : 1 - tail;
}

double student_t_quantile(double p, int degrees_of_freedom) {
  RADFARM_CHECK(p >= 0 && p <= 1 && degrees_of_freedom >= 1);
  if (p == 0.5) return 0;
  const double t = inverse_upper_tail(std::fmin(p, 1 - p),
                                      [&](double y) { return student_upper_tail(y, degrees_of_freedom); });
  return p < 0.5 ? -t : t;
}

}  // namespace radfarm
