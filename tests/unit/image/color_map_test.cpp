#include "image/color_map.h"

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

const float kNan = std::nanf("");

double brightness(const Rgba8& c) {
  const auto linear = [](std::uint8_t b) { return std::pow(b / 255.0, 2.2); };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

TEST(Viridis, GrowsBrighterFromVioletToYellow) {
  EXPECT_EQ(viridis(0), (Rgba8{68, 1, 84, 255}));
  EXPECT_EQ(viridis(1), (Rgba8{253, 231, 37, 255}));
  double last = -1;
  for (int i = 0; i <= 100; ++i) {
    const double now = brightness(viridis(static_cast<float>(i) / 100));
    EXPECT_GT(now, last) << i;
    last = now;
  }
}

TEST(Viridis, IsClampedAndShowsWhatIsNoNumber) {
  EXPECT_EQ(viridis(-5), viridis(0));
  EXPECT_EQ(viridis(std::numeric_limits<float>::infinity()), viridis(1));
  EXPECT_EQ(viridis(kNan), kNotANumber);
}

TEST(ColorOfId, IsTheSameForTheSameAndAnotherForItsNeighbours) {
  std::set<Rgba8> colors;
  for (int id = 0; id < 200; ++id) colors.insert(color_of_id(static_cast<float>(id)));
  EXPECT_GT(colors.size(), 198U);
  EXPECT_EQ(color_of_id(7), color_of_id(7));
  EXPECT_EQ(color_of_id(-1), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(color_of_id(kNan), kNotANumber);
}

TEST(RobustRange, IsNotDecidedBySinglePixels) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>((i * 8) % 1001));
  values[500] = 1e30F;
  values.push_back(kNan);
  values.push_back(std::numeric_limits<float>::infinity());
  const ValueRange range = robust_range(values);
  EXPECT_NEAR(range.low, 10, 1.5);
  EXPECT_NEAR(range.high, 990, 1.5);
  EXPECT_NEAR(range.place(500), 0.5, 0.01);
}

TEST(RobustRange, WithoutWidthEverythingIsAtItsLowEnd) {
  const std::vector<float> same(9, 4.0F);
  const ValueRange range = robust_range(same);
  EXPECT_EQ(range.low, 4);
  EXPECT_EQ(range.high, 4);
  EXPECT_EQ(range.place(4), 0);
  EXPECT_TRUE(std::isnan(range.place(kNan)));
  EXPECT_EQ(robust_range({}).high, 0);
}

}  // namespace
}  // namespace radfarm
