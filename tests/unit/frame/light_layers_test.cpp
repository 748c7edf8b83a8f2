#include "frame/light_layers.h"

#include <cmath>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

PixelSums pixel_of(const std::vector<RadianceParts>& samples) {
  PixelSums pixel;
  for (const RadianceParts& sample : samples) pixel.add(sample);
  return pixel;
}

RadianceParts parts_of(float emission, float direct, float indirect, float specular) {
  return {Spectrum(emission), Spectrum(direct), Spectrum(indirect), Spectrum(specular)};
}

Raster raster_of(const PixelSums& pixel, const AovSums& aovs = {}) {
  Raster raster;
  raster.pixels = {pixel};
  raster.aovs = {aovs};
  raster.counters.camera_rays = pixel.samples;
  return raster;
}

const PixelSums kFirst = pixel_of({parts_of(1, 2, 3, 4), parts_of(0, 1, 0, 5)});
const PixelSums kSecond = pixel_of({parts_of(0, 8, 0, 1), parts_of(2, 0, 3, 0), parts_of(1, 1, 6, 0), parts_of(5, 3, 3, 3)});

TEST(AddLightGroup, AddsMeansAndVariancesOfMeans) {
  Raster sum = raster_of(kFirst);
  add_light_group(raster_of(kSecond), sum);
  const PixelSums& both = sum.pixels[0];
  EXPECT_EQ(both.samples, 6U);
  EXPECT_EQ(sum.counters.camera_rays, 6U);
  EXPECT_NEAR(both.emission.g / 6, 0.5 + 2, 1e-12);
  EXPECT_NEAR(both.direct.g / 6, 1.5 + 3, 1e-12);
  EXPECT_NEAR(both.indirect.g / 6, 1.5 + 3, 1e-12);
  EXPECT_NEAR(both.specular.g / 6, 4.5 + 1, 1e-12);
  EXPECT_NEAR(variance_of_mean(both), variance_of_mean(kFirst) + variance_of_mean(kSecond), 1e-12);
}

TEST(AddLightGroup, OfAPixelWithoutSamplesIsNoBlack) {
  PixelSums lost;
  lost.dropped = 3;
  for (const auto& [a, b] : {std::pair(kFirst, lost), std::pair(lost, kFirst)}) {
    Raster sum = raster_of(a);
    add_light_group(raster_of(b), sum);
    EXPECT_EQ(sum.pixels[0].samples, 0U);
    EXPECT_EQ(sum.pixels[0].dropped, 3U);
  }
}

TEST(AddLightGroup, OfASingleSampleHasNoVariance) {
  Raster sum = raster_of(kFirst);
  add_light_group(raster_of(pixel_of({parts_of(0, 1, 0, 0)})), sum);
  EXPECT_TRUE(std::isnan(variance_of_mean(sum.pixels[0])));
}

TEST(AddLightGroup, AddsLightOfAovsAndKeepsTheRest) {
  AovSums first, second;
  first.albedo = SpectrumD(1.0);  // of 2 samples
  first.normal = {0, 2, 0};
  first.irradiance = SpectrumD(10.0), first.depth = 6, first.hits = 2, first.camera_rays = 2, first.cell = 7;
  second.albedo = SpectrumD(4.0);
  second.irradiance = SpectrumD(9.0), second.depth = 8, second.hits = 3, second.camera_rays = 4, second.cell = 9;
  Raster sum = raster_of(kFirst, first);
  add_light_group(raster_of(kSecond, second), sum);
  const AovSums& both = sum.aovs[0];
  EXPECT_NEAR(both.albedo.r / sum.pixels[0].samples, 0.5, 1e-12);
  EXPECT_NEAR(both.normal.y / sum.pixels[0].samples, 1, 1e-12);
  EXPECT_NEAR(both.irradiance.r / both.hits, 5 + 3, 1e-12);
  EXPECT_EQ(both.depth / both.hits, 3);
  EXPECT_EQ(both.camera_rays, 6U);
  EXPECT_EQ(both.cell, 7U);
}

TEST(LightLayer, IsWhatAllButEmissionAddsUpTo) {
  Image image{1, 1, {}, {}};
  add_light_layer("a-b", raster_of(kFirst), image);
  add_light_layer("z", raster_of(PixelSums()), image);
  EXPECT_EQ(light_groups_of(image), (std::vector<std::string>{"a-b", "z"}));
  EXPECT_EQ(light_layer(image, "a-b").channels.at("G"), std::vector<float>{7.5F});
  EXPECT_TRUE(std::isnan(image.channels.at("light.z.R")[0]));
}

}  // namespace
}  // namespace radfarm
