#include "math/statistics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

TEST(RunningStatistics, MeanAndVarianceOfKnownNumbers) {
  RunningStatistics statistics;
  EXPECT_EQ(statistics.variance(), 0);
  for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) statistics.add(x);
  EXPECT_EQ(statistics.count(), 8U);
  EXPECT_DOUBLE_EQ(statistics.mean(), 5);
  EXPECT_DOUBLE_EQ(statistics.variance(), 32.0 / 7);
  EXPECT_DOUBLE_EQ(statistics.standard_error(), std::sqrt(4.0 / 7));
}

TEST(RunningStatistics, LargeOffsetDoesNotCancel) {
  RunningStatistics statistics;
  for (int i = 0; i < 1000; ++i) statistics.add(1e9 + i % 2);
  EXPECT_NEAR(statistics.variance(), 250.0 / 999, 1e-9);
}

TEST(RunningStatistics, MergingEqualsAddingAll) {
  RandomSequence random(1);
  RunningStatistics whole, left, right;
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform_double();
    whole.add(x);
    (i < 300 ? left : right).add(x);
  }
  left.merge(right);
  left.merge(RunningStatistics());
  EXPECT_EQ(left.count(), whole.count());
  EXPECT_NEAR(left.mean(), whole.mean(), 1e-15);
  EXPECT_NEAR(left.variance(), whole.variance(), 1e-15);
}

TEST(NormalQuantile, KnownValues) {
  EXPECT_EQ(normal_quantile(0.5), 0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-15);
  EXPECT_NEAR(normal_quantile(0.841344746068543), 1, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-6), -4.753424308822899, 1e-14);
  EXPECT_EQ(normal_quantile(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(normal_quantile(0), -std::numeric_limits<double>::infinity());
}

TEST(StudentTQuantile, PrintedTable) {
  EXPECT_NEAR(student_t_quantile(0.975, 1), 12.706204736174695, 1e-12);
  EXPECT_NEAR(student_t_quantile(0.975, 2), 4.302652729749464, 1e-12);
  EXPECT_NEAR(student_t_quantile(0.975, 10), 2.228138851986275, 1e-12);
  EXPECT_NEAR(student_t_quantile(0.995, 30), 2.749995653567225, 1e-12);
  EXPECT_NEAR(student_t_quantile(0.975, 1'000'000), normal_quantile(0.975), 1e-4);
  EXPECT_NEAR(student_t_quantile(0.025, 5), -student_t_quantile(0.975, 5), 1e-12);
}

TEST(StudentTCdf, OneDegreeIsCauchy) {
  for (const double t : {-3.0, -0.5, 0.0, 1.0, 20.0}) EXPECT_NEAR(student_t_cdf(t, 1), 0.5 + std::atan(t) / M_PI, 1e-15);
}

}  // namespace
}  // namespace radfarm
