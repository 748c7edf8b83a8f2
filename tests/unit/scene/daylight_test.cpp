#include "scene/daylight.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/sun_position.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

TEST(Daylight, RelativeLuminanceIsOneAtTheZenithAndNeverNegative) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    for (int sun = 0; sun <= 90; sun += 5) {
      const double sun_zenith = sun * kPiD / 180;
      EXPECT_NEAR(relative_luminance(type, 0, sun_zenith, sun_zenith), 1, 1e-15);
      for (int zenith = 0; zenith <= 90; zenith += 3) {
        for (int apart = 0; apart <= 180; apart += 10) {
          const double value = relative_luminance(type, zenith * kPiD / 180, sun_zenith, apart * kPiD / 180);
          EXPECT_TRUE(std::isfinite(value) && value >= 0)
              << type << " " << sun << " " << zenith << " " << apart << ": " << value;
        }
      }
    }
  }
}

TEST(Daylight, SkyTypesAreThoseOfTheStandard) {
  // By hand from ISO 15469's formulas. The horizon of type 1 without a sun's influence: 1 / (1 + 4 exp(-0.7)).
  EXPECT_NEAR(relative_luminance(1, kPiD / 2, 1, 1), 1 / (1 + 4 * std::exp(-0.7)), 1e-12);
  EXPECT_NEAR(relative_luminance(1, kPiD / 2, 1, 1), 0.334858, 1e-6);
  // Type 5 is uniform.
  EXPECT_EQ(relative_luminance(5, 1.2, 0.7, 0.3), 1);
  // Type 12 is the CIE clear sky of 1973, whose 0.91 stands for 1 - 10 exp(-3 pi / 2) = 0.9102.
  const double sun = kPiD / 3, apart = kPiD / 6, zenith = kPiD / 4;
  const double old = (0.91 + 10 * std::exp(-3 * apart) + 0.45 * std::pow(std::cos(apart), 2)) *
                     (1 - std::exp(-0.32 / std::cos(zenith))) /
                     ((0.91 + 10 * std::exp(-3 * sun) + 0.45 * std::pow(std::cos(sun), 2)) * (1 - std::exp(-0.32)));
  EXPECT_NEAR(relative_luminance(12, zenith, sun, apart), old, 1e-3 * old);
  // The overcast sky's horizon is a third of its zenith.
  EXPECT_NEAR(relative_luminance(16, kPiD / 2, 1, 1), 1.0 / 3, 1e-15);
}

TEST(Daylight, IlluminancesAreThoseOfTheIes) {
  // 127500 exp(-0.21 x 1.15398); 800 + 15500 sqrt(sin 60); 300 + 45000 sin 60; 300 + 21000 sin 60.
  EXPECT_NEAR(air_mass(60), 1.15398, 1e-4);
  EXPECT_NEAR(air_mass(90), 1, 1e-3);
  EXPECT_NEAR(air_mass(0), 38, 0.2);
  EXPECT_NEAR(sun_illuminance(Cloudiness::kClear, 60, 127'500, 0), 100'063, 10);
  EXPECT_NEAR(sun_illuminance(Cloudiness::kPartlyCloudy, 60, 127'500, 0), 50'649, 10);
  EXPECT_EQ(sun_illuminance(Cloudiness::kOvercast, 60, 127'500, 0), 0);
  EXPECT_NEAR(sky_illuminance(Cloudiness::kClear, 60), 15'224.4, 0.1);
  EXPECT_NEAR(sky_illuminance(Cloudiness::kPartlyCloudy, 60), 39'271.1, 0.1);
  EXPECT_NEAR(sky_illuminance(Cloudiness::kOvercast, 60), 18'486.5, 0.1);
  // The air is a tenth of an optical depth: turbidity 2 at the zenith lets exp(-2 / 9.943) through.
  EXPECT_NEAR(sun_illuminance(Cloudiness::kClear, 90, 127'500, 2), 127'500 * 0.81779, 30);
  EXPECT_GT(sun_illuminance(Cloudiness::kClear, 30, 127'500, 2), sun_illuminance(Cloudiness::kClear, 30, 127'500, 5));
}

TEST(Daylight, TwilightFallsToNothing) {
  for (const Cloudiness clouds : {Cloudiness::kClear, Cloudiness::kPartlyCloudy, Cloudiness::kOvercast}) {
    double before = sky_illuminance(clouds, 0);
    for (double elevation = -0.5; elevation > -18; elevation -= 0.5) {
      const double now = sky_illuminance(clouds, elevation);
      EXPECT_GT(now, 0);
      EXPECT_LT(now, before);
      before = now;
    }
    EXPECT_EQ(sky_illuminance(clouds, -18), 0);
    EXPECT_EQ(sun_illuminance(clouds, -1, 127'500, 0), 0);
  }
  EXPECT_NEAR(sky_illuminance(Cloudiness::kClear, -6), 3.4, 1e-9);
}

PlaceAndTime at(double latitude, double longitude, int year, int month, int day, double hour) {
  return {latitude, longitude, year, month, day, hour, 0};
}

/// The highest elevation of a day, seen every ten seconds around noon of Greenwich.
SunPosition culmination(double latitude, int month, int day) {
  SunPosition best;
  best.elevation = -90;
  for (int second = 41'000; second < 45'500; second += 10) {
    const SunPosition now = sun_position(at(latitude, 0, 2024, month, day, second / 3600.0));
    if (now.elevation > best.elevation) best = now;
  }
  return best;
}

TEST(SunPosition, CulminatesAsTheAlmanacSays) {
  // Solstices 2024: declination 23.44; equinox of 20 March 2024 at 03:06 UTC.
  EXPECT_NEAR(culmination(52.5, 6, 21).elevation, 90 - 52.5 + 23.44, 0.03);
  EXPECT_NEAR(culmination(52.5, 12, 21).elevation, 90 - 52.5 - 23.44, 0.1);  // refraction lifts it by 0.06
  EXPECT_NEAR(culmination(52.5, 6, 21).azimuth, 180, 0.1);
  EXPECT_NEAR(culmination(-33.9, 6, 21).elevation, 90 - 33.9 - 23.44, 0.05);
  EXPECT_LT(std::fabs(std::remainder(culmination(-33.9, 6, 21).azimuth, 360)), 0.1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 3, 20, 3.1)).declination, 0, 0.005);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 6, 20, 20.85)).declination, 23.436, 0.003);
}

TEST(SunPosition, KeepsTheEquationOfTime) {
  // Extremes and zeros of a year, in minutes.
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 2, 11, 12)).equation_of_time, -14.2, 0.1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 5, 14, 12)).equation_of_time, 3.65, 0.1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 7, 26, 12)).equation_of_time, -6.54, 0.1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 11, 3, 12)).equation_of_time, 16.45, 0.1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 4, 15, 12)).equation_of_time, 0, 0.3);
}

TEST(SunPosition, AgreesWithTheExampleOfReda) {
  // Reda and Andreas (2004), NREL/TP-560-34302, A.5: zenith angle 50.11162 with refraction at 820 mbar, azimuth
  // 194.34024.
  PlaceAndTime golden = at(39.742476, -105.1786, 2003, 10, 17, 12 + 30.0 / 60 + 30.0 / 3600);
  golden.zone = -7;
  const SunPosition sun = sun_position(golden);
  EXPECT_NEAR(90 - sun.elevation, 50.11162, 0.02);
  EXPECT_NEAR(sun.azimuth, 194.34024, 0.02);
}

TEST(SunPosition, RisesInTheEastAndZonesShiftTheClock) {
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 3, 20, 7)).azimuth, 90, 1);
  EXPECT_NEAR(sun_position(at(0, 0, 2024, 3, 20, 17)).azimuth, 270, 1);
  PlaceAndTime berlin = at(52.5, 13.4, 2026, 6, 21, 12);
  berlin.zone = 2;
  EXPECT_NEAR(sun_position(berlin).elevation, sun_position(at(52.5, 13.4, 2026, 6, 21, 10)).elevation, 1e-9);
}

}  // namespace
}  // namespace radfarm
