#include "image/compare.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Image grey(std::vector<float> values) {
  Image image;
  image.width = static_cast<int>(values.size());
  image.height = 1;
  image.channels = {{"R", values}, {"G", values}, {"B", values}};
  return image;
}

TEST(Compare, EqualImagesDifferByNothing) {
  const Comparison result = compare(grey({1, 2, 3}), grey({1, 2, 3})).value();
  EXPECT_EQ(result.rmse, 0);
  EXPECT_EQ(result.relmse, 0);
  EXPECT_EQ(result.ratio_of_means, 1);
  EXPECT_EQ(result.pixels, 3U);
}

TEST(Compare, KnownDifferences) {
  const Comparison result = compare(grey({1, 5}), grey({2, 2})).value();
  EXPECT_NEAR(result.rmse, std::sqrt(5.0), 1e-12);  // mean of 1 and 9
  EXPECT_NEAR(result.relative_rmse, std::sqrt(5.0) / 2, 1e-12);
  EXPECT_NEAR(result.relmse, 5 / 4.04, 1e-12);
  EXPECT_NEAR(result.ratio_of_means, 1.5, 1e-12);
  EXPECT_EQ(result.max_difference, 3);
  EXPECT_NEAR(result.channel_rmse[2], std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(result.channel_mean_ratio[0], 1.5, 1e-12);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedNotAveraged) {
  const Comparison result =
      compare(grey({1, std::numeric_limits<float>::quiet_NaN(), 3}), grey({1, 1, std::numeric_limits<float>::infinity()}))
          .value();
  EXPECT_EQ(result.pixels, 1U);
  EXPECT_EQ(result.not_finite, 2U);
  EXPECT_EQ(result.rmse, 0);
}

TEST(Compare, BlackImages) {
  EXPECT_EQ(compare(grey({0}), grey({0})).value().relative_rmse, 0);
  EXPECT_EQ(compare(grey({0}), grey({0})).value().ratio_of_means, 1);
  EXPECT_TRUE(std::isinf(compare(grey({1}), grey({0})).value().relative_rmse));
}

TEST(Compare, SizesMustAgree) {
  EXPECT_EQ(compare(grey({1}), grey({1, 2})).error().code, Code::kInvalidArgument);
  EXPECT_EQ(compare(grey({std::nanf("")}), grey({1})).error().code, Code::kInvalidArgument);
}

TEST(CompareRegions, TellsWhereTheErrorIs) {
  const Image a = grey({1, 1, 3, 5}), b = grey({1, 1, 2, 2});
  const std::vector<RegionError> regions = compare_regions(a, b, 2, 1).value();
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[1].x0, 2);
  EXPECT_EQ(regions[1].x1, 4);
  EXPECT_EQ(regions[0].share, 0);
  EXPECT_NEAR(regions[1].share, 1, 1e-12);
  EXPECT_NEAR(regions[1].rmse, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(regions[1].relative_rmse, std::sqrt(5.0) / 2, 1e-12);
  EXPECT_NEAR(regions[1].ratio_of_means, 2, 1e-12);
  EXPECT_EQ(compare_regions(a, b, 5, 1).error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
