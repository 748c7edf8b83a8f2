#include "meters/meter.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Reading reading(double lux, double half_width = 0) { return {SpectrumD(lux), half_width, 1}; }

TEST(Meter, SummaryIsWhatStandardsAsk) {
  const Summary s = summarise(std::vector{reading(100, 1), reading(300, 30), reading(200)});
  EXPECT_EQ(s.points, 3U);
  EXPECT_DOUBLE_EQ(s.least, 100);
  EXPECT_DOUBLE_EQ(s.mean, 200);
  EXPECT_DOUBLE_EQ(s.most, 300);
  EXPECT_DOUBLE_EQ(s.uniformity, .5);
  EXPECT_DOUBLE_EQ(s.diversity, 1.0 / 3);
  EXPECT_DOUBLE_EQ(s.widest, .1);
}

TEST(Meter, InTheDarkNothingIsUniform) {
  const Summary s = summarise(std::vector{reading(0), reading(0)});
  EXPECT_EQ(s.uniformity, 0);
  EXPECT_EQ(s.diversity, 0);
  EXPECT_EQ(s.widest, 0);
}

TEST(Meter, HalfWidthIsStudents) {
  // Mean 2, standard deviation 1, of 4: t(.975, 3) = 3.182446.
  EXPECT_NEAR(half_width_of(std::vector<double>{1, 3, 1.2928932188, 2.7071067812}),
              3.182446 * std::sqrt((1 + 1 + .5 + .5) / 3 / 4), 1e-5);
}

}  // namespace
}  // namespace radfarm
