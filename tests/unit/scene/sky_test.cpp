#include "scene/sky.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>

#include "scene/environment_light.h"

namespace radfarm {
namespace {

using testing::HasSubstr;
constexpr double kPiD = std::numbers::pi;

Environment sky(const std::string& parameters) {
  const Result<Environment> environment = make_sky(parameters);
  EXPECT_TRUE(environment) << environment.error().message;
  return environment.value_or(Environment());
}

/// On a plane, of what is interpolated from the map, without the sun.
double illuminance(const Environment& environment, const Vec3d& normal) {
  const LatLongMap map(environment);
  constexpr int kRows = 2048, kColumns = 512;
  double sum = 0;
  for (int i = 0; i < (normal.y == 1 ? kRows / 2 : kRows); ++i) {
    const double colatitude = kPiD * (i + 0.5) / kRows;
    for (int j = 0; j < kColumns; ++j) {
      const LatLong place{2 * kPiD * (j + 0.5) / kColumns, colatitude};
      const double cosine = dot(direction_at(place), normal);
      if (cosine > 0) sum += static_cast<double>(luminance(map.radiance(place))) * cosine * std::sin(colatitude);
    }
  }
  return sum * kPiD / kRows * 2 * kPiD / kColumns;
}

double sun_lux(const Environment& environment) {
  const double c = static_cast<double>(environment.sun.cos_radius);
  return static_cast<double>(luminance(environment.sun.radiance)) * 2 * kPiD * (1 - c);
}

TEST(Sky, TheOvercastOneHasItsClosedForms) {
  // (O14) on the ground 7 pi / 9 of the zenith's luminance, on a wall 0.396177 of that when the ground is black.
  const Environment environment = sky("overcast,sky_lux=10000,ground=0");
  EXPECT_NEAR(illuminance(environment, {0, 1, 0}), 10'000, 0.1);
  EXPECT_NEAR(static_cast<double>(luminance(environment.radiance[0])), 10'000 * 9 / (7 * kPiD), 1);
  EXPECT_NEAR(illuminance(environment, {1, 0, 0}) / 10'000, 0.396177, 1e-4);
  EXPECT_NEAR(illuminance(environment, normalize(Vec3d(1, 0, -1))) / 10'000, 0.396177, 1e-4);
  EXPECT_TRUE(is_black(environment.sun.radiance));
}

TEST(Sky, EachTypeKeepsItsIlluminanceAtAnySun) {
  for (int type = 1; type <= 16; ++type) {
    for (const int elevation : {0, 30, 90}) {
      const Environment environment =
          sky("type=" + std::to_string(type) + ",sky_lux=12345,elevation=" + std::to_string(elevation));
      for (const Spectrum& texel : environment.radiance) ASSERT_TRUE(is_finite(texel) && texel.g >= 0);
      EXPECT_NEAR(illuminance(environment, {0, 1, 0}), 12'345, 1e-4 * 12'345) << type << " " << elevation;
    }
  }
}

TEST(Sky, TheSunBringsItsIlluminanceFromItsPlace) {
  const Environment environment = sky("elevation=30,azimuth=90,sun_lux=80000,sky_lux=10000");
  EXPECT_LT(length(environment.sun.direction - Vec3(std::sqrt(0.75F), 0.5F, 0)), 1e-6F);
  EXPECT_NEAR(sun_lux(environment), 80'000, 8);
  const EnvironmentLight light(environment);
  EXPECT_NEAR(std::acos(static_cast<double>(environment.sun.cos_radius)) * 2 / kPiD * 180, 0.533, 0.001);
  EXPECT_GT(light.radiance(environment.sun.direction).g, 1e9F);
  // The ground below the horizon: albedo / pi of the global illuminance.
  EXPECT_NEAR(luminance(light.radiance({0, -1, 0})), 0.2 / kPiD * (10'000 + 40'000), 0.1);
  // North turns it all.
  const Environment turned = sky("elevation=30,azimuth=90,sun_lux=80000,sky_lux=10000,north=90");
  EXPECT_LT(length(turned.sun.direction - Vec3(0, 0.5F, std::sqrt(0.75F))), 1e-6F);
}

TEST(Sky, LevelsFollowTheIesWhenNoneAreGiven) {
  const Environment clear = sky("clear,elevation=60");
  EXPECT_NEAR(sun_lux(clear), 100'063, 20);
  EXPECT_NEAR(illuminance(clear, {0, 1, 0}), 15'224.4, 2);
  const Environment hazy = sky("clear,elevation=60,turbidity=5");
  EXPECT_LT(sun_lux(hazy), 75'000);
  EXPECT_NEAR(illuminance(sky("overcast,elevation=60"), {0, 1, 0}), 18'486.5, 2);
  EXPECT_FALSE(is_black(sky("").sun.radiance));
}

TEST(Sky, APlaceAndTimePutTheSunWhereItIs) {
  const Environment berlin = sky("lat=52.5,lon=13.4,date=2026-06-21,time=13:08,zone=+2,turbidity=3");
  const double elevation = std::asin(static_cast<double>(berlin.sun.direction.y)) / kPiD * 180;
  EXPECT_NEAR(elevation, 90 - 52.5 + 23.44, 0.1);
  EXPECT_GT(berlin.sun.direction.z, 0);  // in the south
  EXPECT_NEAR(berlin.sun.direction.x, 0, 0.01);
  EXPECT_NEAR(sun_lux(berlin), 127'500 * 0.967 * std::exp(-3 * 1.144 / (9.9 + 0.049)), 700);
}

TEST(Sky, UniformHasOneLuminance) {
  const Environment environment = sky("uniform,luminance=1000,ground=1");
  for (const Spectrum& texel : environment.radiance) ASSERT_NEAR(luminance(texel), 1000, 0.01);
  EXPECT_NEAR(illuminance(sky("uniform,lux=10000"), {0, 1, 0}), 10'000, 0.1);
}

TEST(Sky, WithoutAnyLightIsAnErrorThatSaysSo) {
  const Result<Environment> night = make_sky("lat=52.5,lon=13.4,date=2026-12-21,time=00:00,zone=1");
  ASSERT_FALSE(night);
  EXPECT_EQ(night.error().code, Code::kFailedPrecondition);
  EXPECT_THAT(night.error().message, HasSubstr("nothing shines"));
  EXPECT_TRUE(make_sky("elevation=-5"));
  EXPECT_FALSE(make_sky("elevation=-5,sun_lux=100"));
}

TEST(Sky, WrongParametersAreNamed) {
  struct Wrong {
    const char *text, *message;
  };
  for (const Wrong& wrong :
       {Wrong{"cloud=3", "'cloud=3' is not known; there are lat="}, Wrong{"cloudy", "sun_lux="},
        Wrong{"type=17", "type=17 should be a number from 1 to 16"}, Wrong{"type=1.5", "whole number"},
        Wrong{"elevation=x", "elevation=x"}, Wrong{"elevation=nan", "elevation=nan"}, Wrong{"elevation", "elevation"},
        Wrong{"elevation=91", "from -90 to 90"}, Wrong{"lat=52", "lon= is missing"},
        Wrong{"lat=1,lon=1,date=2026-02-30,time=12:00,zone=0", "date=2026-02-30"},
        Wrong{"lat=1,lon=1,date=2026-02-03,time=12.5,zone=0", "time=12.5"},
        Wrong{"lat=1,lon=1,date=2026-02-03,time=12:00,zone=0,azimuth=3", "azimuth="},
        Wrong{"clear,type=3", "given twice"}, Wrong{"uniform", "lux="}, Wrong{"luminance=3", "sky:uniform"},
        Wrong{"sky_lux=1,lux=1", "same"}, Wrong{"ground=2", "ground=2"}, Wrong{",", "''"}}) {
    const Result<Environment> environment = make_sky(wrong.text);
    ASSERT_FALSE(environment) << wrong.text;
    EXPECT_EQ(environment.error().code, Code::kInvalidArgument);
    EXPECT_THAT(environment.error().message, HasSubstr(wrong.message)) << wrong.text;
  }
}

}  // namespace
}  // namespace radfarm
