#include "image/rgb.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(RgbLayer, RootAndNamedLayersAreFound) {
  Image image{1, 1, {{"R", {1}}, {"G", {2}}, {"B", {3}}, {"direct.R", {4}}, {"direct.G", {5}}, {"direct.B", {6}}}, {}};
  EXPECT_EQ(rgb_layer(image).value().at(0), Spectrum(1, 2, 3));
  EXPECT_EQ(rgb_layer(image, "direct").value().at(0), Spectrum(4, 5, 6));
  EXPECT_EQ(rgb_layer(image, "specular").error().code, Code::kInvalidArgument);
  image.channels["G"].clear();
  EXPECT_EQ(rgb_layer(image).error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
