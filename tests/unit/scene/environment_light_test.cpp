#include "scene/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

Environment even_map(std::uint32_t width, std::uint32_t height, float value) {
  Environment e;
  e.width = width;
  e.height = height;
  e.radiance.assign(std::size_t{width} * height, Spectrum(value));
  return e;
}

Environment with_sun(Environment e, double degrees, float radiance) {
  e.sun.direction = normalize(Vec3(0.2F, 0.7F, 0.1F));
  e.sun.cos_radius = static_cast<float>(std::cos(degrees / 2 / 180 * kPiD));
  e.sun.radiance = Spectrum(radiance);
  return e;
}

TEST(EnvironmentLight, WithoutLightIsEmpty) {
  EXPECT_TRUE(EnvironmentLight(Environment()).is_empty());
  const Environment black = even_map(8, 4, 0);
  const EnvironmentLight light(black);
  EXPECT_TRUE(light.is_empty());
  EXPECT_EQ(light.radiance({0, 1, 0}), Spectrum());
  EXPECT_EQ(light.pdf({0, 1, 0}), 0);
  EXPECT_EQ(light.total(), Spectrum());
}

TEST(EnvironmentLight, AnEvenMapBringsFourPi) {
  for (const std::uint32_t height : {1U, 2U, 64U}) {
    const Environment environment = even_map(2 * height, height, 3);
    const EnvironmentLight light(environment);
    EXPECT_NEAR(light.total().g, 12 * kPi, 1e-4F);
    EXPECT_EQ(light.max_luminance(), luminance(Spectrum(3)));
    EXPECT_NEAR(light.pdf(normalize(Vec3(1, 2, 3))), 1 / (4 * kPi), 1e-7F);
  }
}

/// What every environment must hold, with directions drawn both by the light and evenly.
void expect_sound(const Environment& environment) {
  const EnvironmentLight light(environment);
  ASSERT_FALSE(light.is_empty());
  SpectrumD sum;
  double probability = 0;
  for (std::uint32_t p = 0; p < light.patches().size(); ++p) {
    const SkyPatch& patch = light.patches()[p];
    sum += SpectrumD(patch.irradiance);
    probability += light.probability(p);
    EXPECT_GT(light.probability(p), 0);
    EXPECT_GT(patch.solid_angle, 0);
    EXPECT_NEAR(length(patch.direction), 1, 1e-6F);
  }
  const double total = static_cast<double>(light.total().g);
  EXPECT_NEAR(sum.g, total, 1e-5 * total);
  EXPECT_NEAR(probability, 1, 1e-12);
  RandomSequence random(1);
  for (int i = 0; i < 2'000; ++i) {
    const double choice = random.uniform_double();
    const Vec2 u(random.uniform(), random.uniform());
    const EnvironmentLight::Sample s = light.sample(choice, u);
    EXPECT_GT(s.pdf, 0);
    EXPECT_TRUE(std::isfinite(s.pdf) && is_finite(s.radiance));
    EXPECT_NEAR(length(s.direction), 1, 1e-6F);
    const Vec3 even = sample_uniform_sphere(u);
    if (!is_black(light.radiance(even))) {
      EXPECT_GT(light.pdf(even), 0) << even;
    }
  }
  for (const float u : {0.0F, 0.99999994F}) {
    for (const double choice : {0.0, 1 - 1e-16}) EXPECT_GT(light.sample(choice, {u, u}).pdf, 0);
  }
}

TEST(EnvironmentLight, HoldsOfHardMaps) {
  expect_sound(even_map(1, 1, 2));
  expect_sound(even_map(2, 1, 1e9F));
  expect_sound(even_map(64, 32, 1e-30F));
  for (const std::size_t bright :
       {std::size_t{0}, std::size_t{63}, std::size_t{64 * 16 + 5}, std::size_t{64 * 32 - 1}}) {
    Environment spike = even_map(64, 32, 1);
    spike.radiance[bright] = Spectrum(1e6F);
    expect_sound(spike);
    Environment only = even_map(64, 32, 0);
    only.radiance[bright] = Spectrum(1e9F);
    expect_sound(only);
    expect_sound(with_sun(only, 0.533, 1e9F));
  }
  expect_sound(with_sun({}, 0.533, 1.6e9F));
  expect_sound(with_sun({}, 360, 1));
  expect_sound(with_sun(even_map(512, 256, 5000), 0.05, 1e12F));
}

TEST(EnvironmentLight, TheSunIsInItsDiscAndNowhereElse) {
  const Environment environment = with_sun({}, 0.533, 1e9F);
  const EnvironmentLight light(environment);
  const Vec3d axis = normalize(to_double(environment.sun.direction)), across = normalize(cross(axis, Vec3d(1, 0, 0)));
  const double radius = std::acos(static_cast<double>(environment.sun.cos_radius));
  for (const double share : {0.0, 0.5, 0.9999, 1.0001, 2.0, 100.0}) {
    const Vec3 way = to_float(axis * std::cos(share * radius) + across * std::sin(share * radius));
    EXPECT_EQ(light.radiance(way).r, share < 1 ? 1e9F : 0) << share;
    EXPECT_EQ(light.pdf(way) > 0, share < 1) << share;
  }
  const double solid_angle = 2 * kPiD * (1 - static_cast<double>(environment.sun.cos_radius));
  EXPECT_NEAR(light.total().g / (1e9 * solid_angle), 1, 1e-6);
  EXPECT_EQ(light.patches().size(), 1U);
  EXPECT_EQ(light.max_luminance(), luminance(Spectrum(1e9F)));
}

TEST(EnvironmentLight, ASunWithoutExtentGivesNothing) {
  Environment environment = with_sun({}, 0.533, 1e9F);
  environment.sun.cos_radius = 1;
  EXPECT_TRUE(EnvironmentLight(environment).is_empty());
}

TEST(EnvironmentLight, PatchesAreAsFineAsTregenzasAndFinerWhereItIsBright) {
  Environment environment = even_map(256, 128, 1);
  environment.radiance[40 * 256 + 100] = Spectrum(1e4F);
  const EnvironmentLight light(environment);
  EXPECT_GE(light.patches().size(), 290U);
  EXPECT_LE(light.patches().size(), 1200U);
  const double total = static_cast<double>(luminance(light.total()));
  std::vector<int> patches_of_texel(256 * 128);
  for (const SkyPatch& patch : light.patches()) {
    const TexelRect& r = patch.texels;
    EXPECT_LE((r.row_end - r.row_begin) * 180.0 / 128, 12);
    const bool is_texel = r.row_end - r.row_begin == 1 && r.column_end - r.column_begin == 1;
    EXPECT_TRUE(is_texel || static_cast<double>(luminance(patch.irradiance)) <= total / 256 * 1.001);
    for (std::uint32_t row = r.row_begin; row < r.row_end; ++row) {
      for (std::uint32_t c = r.column_begin; c < r.column_end; ++c) ++patches_of_texel[row * 256 + c];
    }
    // Its light comes from where it is.
    const auto texel = LatLongMap(environment).texel_at(latlong_of(to_double(patch.direction)));
    EXPECT_TRUE(texel.row + 1 >= r.row_begin && texel.row <= r.row_end) << texel.row;
  }
  EXPECT_EQ(std::count(patches_of_texel.begin(), patches_of_texel.end(), 1), 256 * 128);
}

TEST(EnvironmentLight, SmallMapsHaveAPatchForEachTexelAndDarkOnesNone) {
  const Environment even = even_map(16, 8, 1);
  EXPECT_EQ(EnvironmentLight(even).patches().size(), 128U);
  Environment half = even_map(256, 128, 1);
  std::fill(half.radiance.begin() + 256 * 64, half.radiance.end(), Spectrum());
  const EnvironmentLight light(half);
  EXPECT_GE(light.patches().size(), 145U);
  for (const SkyPatch& patch : light.patches()) EXPECT_LE(patch.texels.row_begin, 64U);
}

}  // namespace
}  // namespace radfarm
