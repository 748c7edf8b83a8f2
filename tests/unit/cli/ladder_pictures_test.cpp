#include "cli/ladder_pictures.h"

#include <limits>

#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

Image rows(int width, const std::vector<float>& values) {
  Image image;
  image.width = width, image.height = static_cast<int>(values.size()) / width;
  for (const char* c : {"R", "G", "B"}) image.channels[c] = values;
  return image;
}

TEST(Shrunk, HasTheMeansOfItsBoxes) {
  const Image small = shrunk(rows(4, {1, 3, 5, 7, 1, 3, 5, std::numeric_limits<float>::quiet_NaN()}), 2);
  EXPECT_EQ(small.width, 2);
  EXPECT_EQ(small.height, 1);
  EXPECT_EQ(small.channels.at("G")[0], 2);
  EXPECT_NEAR(small.channels.at("G")[1], 17.0F / 3, 1e-6F);
  EXPECT_EQ(shrunk(rows(2, {1, 2}), 100).width, 2) << "never larger";
}

TEST(DifferencePicture, IsOfTheReferencesSize) {
  EXPECT_TRUE(difference_picture(rows(2, {1, 2}), rows(2, {1, 4}), .2));
  EXPECT_TRUE(difference_picture(rows(2, {0, 0}), rows(2, {0, 0}), .2)) << "black";
  EXPECT_EQ(mean_of(rows(2, {1, 2}), rows(2, {3, 4})).channels.at("B"), (std::vector<float>{2, 3}));
}

}  // namespace
}  // namespace radfarm::cli
