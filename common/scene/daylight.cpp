#include "scene/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace radfarm {
namespace {

constexpr double kPi_2 = std::numbers::pi / 2;
constexpr double kDegree = std::numbers::pi / 180;

/// ISO 15469:2004, table 1: gradation a, b; indicatrix c, d, e.
struct SkyType {
  double a, b, c, d, e;
};
constexpr std::array<SkyType, 15> kTypes = {{{4.0, -0.70, 0, -1.0, 0},
                                             {4.0, -0.70, 2, -1.5, 0.15},
                                             {1.1, -0.80, 0, -1.0, 0},
                                             {1.1, -0.80, 2, -1.5, 0.15},
                                             {0.0, -1.00, 0, -1.0, 0},
                                             {0.0, -1.00, 2, -1.5, 0.15},
                                             {0.0, -1.00, 5, -2.5, 0.30},
                                             {0.0, -1.00, 10, -3.0, 0.45},
                                             {-1.0, -0.55, 2, -1.5, 0.15},
                                             {-1.0, -0.55, 5, -2.5, 0.30},
                                             {-1.0, -0.55, 10, -3.0, 0.45},
                                             {-1.0, -0.32, 10, -3.0, 0.45},
                                             {-1.0, -0.32, 16, -3.0, 0.30},
                                             {-1.0, -0.15, 16, -3.0, 0.30},
                                             {-1.0, -0.15, 24, -2.8, 0.15}}};

double gradation(const SkyType& t, double zenith_angle) {
  return 1 + t.a * (zenith_angle < kPi_2 ? std::exp(t.b / std::cos(zenith_angle)) : 0);
}

double indicatrix(const SkyType& t, double from_sun) {
  const double cosine = std::cos(from_sun);
  return 1 + t.c * (std::exp(t.d * from_sun) - std::exp(t.d * kPi_2)) + t.e * cosine * cosine;
}

}  // namespace

double relative_luminance(int type, double zenith_angle, double sun_zenith_angle, double from_sun) {
  if (type == kSkyTypes) return (1 + 2 * std::cos(zenith_angle)) / 3;
  const SkyType& t = kTypes[static_cast<std::size_t>(type - 1)];
  return gradation(t, zenith_angle) * indicatrix(t, from_sun) / (gradation(t, 0) * indicatrix(t, sun_zenith_angle));
}

Cloudiness cloudiness(int type) {
  if (type <= 5 || type == kSkyTypes) return Cloudiness::kOvercast;
  return type <= 10 ? Cloudiness::kPartlyCloudy : Cloudiness::kClear;
}

double air_mass(double elevation) {
  return 1 / (std::sin(elevation * kDegree) + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
}

double extraterrestrial_illuminance(double day_angle) {
  // The earth is nearest to the sun on 2 or 3 January.
  return 127'500 * (1 + 0.034 * std::cos(day_angle - 2 * std::numbers::pi * 2 / 365));
}

double sun_illuminance(Cloudiness clouds, double elevation, double extraterrestrial, double turbidity) {
  if (elevation <= 0 || clouds == Cloudiness::kOvercast) return 0;
  const double m = air_mass(elevation);
  if (turbidity > 0) return extraterrestrial * std::exp(-turbidity * m / (9.9 + 0.043 * m));
  return extraterrestrial * std::exp(-(clouds == Cloudiness::kClear ? 0.21 : 0.80) * m);
}

double sky_illuminance(Cloudiness clouds, double elevation) {
  const double sine = std::sin(std::max(0.0, elevation) * kDegree);
  double level = 300 + 21'000 * sine;
  if (clouds == Cloudiness::kClear) level = 800 + 15'500 * std::sqrt(sine);
  if (clouds == Cloudiness::kPartlyCloudy) level = 300 + 45'000 * sine;
  if (elevation >= 0) return level;
  if (elevation <= -18) return 0;
  // Twilight under a clear sky, in straight lines of the logarithm; clouds take the share that they take at sunset.
  struct Landmark {
    double elevation, lux;
  };
  constexpr std::array<Landmark, 4> kTwilight = {{{0, 800}, {-6, 3.4}, {-12, 0.008}, {-18, 0.0006}}};
  std::size_t i = 1;
  while (elevation < kTwilight[i].elevation) ++i;
  const Landmark &before = kTwilight[i - 1], &after = kTwilight[i];
  const double share = (elevation - before.elevation) / (after.elevation - before.elevation);
  return level / 800 * before.lux * std::pow(after.lux / before.lux, share);
}

}  // namespace radfarm
