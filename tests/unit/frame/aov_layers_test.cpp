#include "frame/aov_layers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frame/aov_picture.h"

namespace radfarm {
namespace {

constexpr AovSet kAll = (AovSet{1} << kAovCount) - 1;

/// Three pixels: two samples of which one hits, two that see nothing, and none that is kept.
Raster example() {
  Raster raster;
  raster.pixels.resize(3);
  raster.aovs.resize(3);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const float light : {1.0F, 3.0F}) raster.pixels[i].add({{}, Spectrum(light), {}, {}});
  }
  raster.aovs[0].add({true, {}, {0, 0.6F, 0.8F}, Spectrum(0.5F), Spectrum(100.0F), 7, 9, {1, 2, 0, 1}, 0.25F}, 4);
  raster.elevation = {2, 1, {1.5F, 3}};
  raster.aovs[0].camera_rays = 2, raster.aovs[0].visibility_rays = 50, raster.aovs[0].form_factor_samples = 30;
  return raster;
}

Image layers(AovSet set) {
  Image image{3, 1, {}, {}};
  add_aov_layers(set, example(), image);
  return image;
}

float value(const Image& image, const char* channel, std::size_t pixel) { return image.channels.at(channel).at(pixel); }

TEST(AovLayers, HaveTheirMeansAndTheirUnits) {
  const Image image = layers(kAll);
  EXPECT_EQ(value(image, "albedo.G", 0), 0.25F) << "what sees nothing counts as black";
  EXPECT_FLOAT_EQ(value(image, "normal.Z", 0), 0.4F);
  EXPECT_EQ(value(image, "depth.Z", 0), 4) << "of what is seen alone";
  EXPECT_EQ(value(image, "irradiance.R", 0), 100);
  EXPECT_EQ(value(image, "samples.camera", 0), 2);
  EXPECT_EQ(value(image, "samples.visibility", 0), 50);
  EXPECT_EQ(value(image, "samples.formfactor", 0), 30);
  EXPECT_FLOAT_EQ(value(image, "variance.Y", 0), 1) << "of {1, 3}: 2, of their mean: 1";
  EXPECT_EQ(value(image, "classification.interpolated", 0), 0.25F);
  EXPECT_EQ(value(image, "classification.formfactor", 0), 0.5F);
  EXPECT_EQ(value(image, "classification.visibility", 0), 0);
  EXPECT_EQ(value(image, "classification.both", 0), 0.25F);
  EXPECT_EQ(value(image, "grid.cell", 0), 7);
  EXPECT_EQ(value(image, "grid.vertex", 0), 9);
  EXPECT_EQ(value(image, "masking.threshold", 0), 0.25F);
  EXPECT_EQ(value(image, "masking.elevation", 0), 1.5F) << "two blocks over three pixels";
  EXPECT_EQ(value(image, "masking.elevation", 1), 1.5F);
}

TEST(AovLayers, WhatSeesNothingIsZeroAndInNoCell) {
  const Image image = layers(kAll);
  for (const char* channel : {"albedo.R", "normal.X", "depth.Z", "irradiance.B", "classification.both"}) {
    EXPECT_EQ(value(image, channel, 1), 0) << channel;
  }
  EXPECT_EQ(value(image, "grid.cell", 1), -1);
}

TEST(AovLayers, APixelWithoutAKeptSampleIsNeverBlack) {
  for (const auto& [name, values] : layers(kAll).channels) EXPECT_TRUE(std::isnan(values[2])) << name;
}

TEST(AovLayers, OnlyThoseThatAreAskedForAreThere) {
  const Image image = layers(set_of(Aov::kDepth) | set_of(Aov::kGrid));
  EXPECT_EQ(image.channels.size(), 3U);
  EXPECT_EQ(aovs_of(image), set_of(Aov::kDepth) | set_of(Aov::kGrid));
  EXPECT_EQ(aovs_of(layers(kAll)), kAll);
}

TEST(AovPicture, EachFillsTheImageAndSaysWhatItMeans) {
  const Image image = layers(kAll);
  for (std::size_t k = 0; k < kAovCount; ++k) {
    const AovPicture picture = draw_aov(image, static_cast<Aov>(k));
    ASSERT_EQ(picture.pixels.size(), 3U) << k;
    EXPECT_FALSE(picture.legend.empty());
    EXPECT_EQ(picture.pixels[2], kNotANumber) << k;
  }
  EXPECT_EQ(draw_aov(image, Aov::kDepth).legend, "4 to 4 m, violet to yellow") << "0 is no depth";
  EXPECT_EQ(draw_aov(image, Aov::kNormal).pixels[1], (Rgba8{128, 128, 128, 255}));
  EXPECT_EQ(draw_aov(image, Aov::kGrid).pixels[1], (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(draw_aov(image, Aov::kClassification).pixels[0], (Rgba8{64, 191, 96, 255}));
}

}  // namespace
}  // namespace radfarm
