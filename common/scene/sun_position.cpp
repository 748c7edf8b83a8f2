#include "scene/sun_position.h"

#include <cmath>
#include <numbers>

namespace radfarm {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double wrap(double value, double period) { return value - period * std::floor(value / period); }
/// Into [-period / 2, period / 2).
double wrap_around_0(double value, double period) { return wrap(value + period / 2, period) - period / 2; }

/// Days since noon UTC of 1 January 2000. [Fliegel and Van Flandern 1968]
double days_since_2000(const PlaceAndTime& at) {
  const int shift = (at.month - 14) / 12;
  const int julian = (1461 * (at.year + 4800 + shift)) / 4 + (367 * (at.month - 2 - 12 * shift)) / 12 -
                     (3 * ((at.year + 4900 + shift) / 100)) / 4 + at.day - 32075;
  return julian - 2451545 + (at.hour - at.zone - 12) / 24;
}

/// Degrees by which air lifts the sun, from its true elevation in degrees.
double refraction(double e) {
  if (e < -0.56) return 0.56;
  return 3.51561 * (0.1594 + 0.0196 * e + 0.00002 * e * e) / (1 + 0.505 * e + 0.0845 * e * e);
}

}  // namespace

SunPosition sun_position(const PlaceAndTime& at) {
  const double n = days_since_2000(at);
  // On the ecliptic: mean longitude, mean anomaly, and with the ellipse's first two terms the true longitude.
  const double mean_longitude = wrap(280.460 + 0.9856474 * n, 360);
  const double anomaly = wrap(357.528 + 0.9856003 * n, 360) * kDegree;
  const double longitude = (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * kDegree;
  const double obliquity = (23.439 - 0.0000004 * n) * kDegree;
  // On the equator.
  const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)) / kDegree;
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  // At the place: sidereal time is degrees here, 15 an hour.
  const double sidereal = 15 * (6.697375 + 0.0657098242 * n + (at.hour - at.zone)) + at.longitude;
  const double hour_angle = wrap_around_0(sidereal - right_ascension, 360) * kDegree;
  const double latitude = at.latitude * kDegree;
  const double up =
      std::sin(declination) * std::sin(latitude) + std::cos(declination) * std::cos(latitude) * std::cos(hour_angle);
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north =
      std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
  SunPosition sun;
  const double elevation = std::atan2(up, std::hypot(east, north)) / kDegree;
  sun.elevation = elevation + (elevation > 89 ? 0 : refraction(elevation));
  sun.azimuth = wrap(std::atan2(east, north) / kDegree, 360);
  sun.declination = declination / kDegree;
  sun.equation_of_time = 4 * wrap_around_0(mean_longitude - right_ascension, 360);
  sun.day_angle = 2 * std::numbers::pi * wrap(n + 0.5, 365.25) / 365.25;
  return sun;
}

}  // namespace radfarm
