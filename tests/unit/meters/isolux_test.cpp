#include "meters/isolux.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Isolux, LevelsAreRoundNumbers) {
  EXPECT_EQ(contour_levels(0, 800), (std::vector<double>{0, 100, 200, 300, 400, 500, 600, 700, 800}));
  EXPECT_EQ(contour_levels(130, 470).front(), 150);
  EXPECT_EQ(contour_levels(.7, 3.4)[4], 1.6);
  EXPECT_TRUE(contour_levels(5, 5).empty());
}

TEST(Isolux, DrawsWhatIsThere) {
  WorkPlane plane;
  plane.columns = 4, plane.rows = 2;
  plane.meter_of = {0, 1, kNone, 2, 3, 4, 5, 6};
  std::vector<Reading> readings;
  for (int i = 0; i < 7; ++i) readings.push_back({SpectrumD(i), 0, 1});
  const auto png = isolux_png(plane, readings, contour_levels(0, 6));
  ASSERT_TRUE(png);
  EXPECT_GT(png->size(), 100U);
}

}  // namespace
}  // namespace radfarm
