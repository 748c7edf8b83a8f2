#pragma once

namespace radfarm {

/// A moment on the civil calendar at a place.
struct PlaceAndTime {
  double latitude = 0;   // degrees, north positive
  double longitude = 0;  // degrees, east positive
  int year = 2000;
  int month = 1;  // 1 to 12
  int day = 1;
  double hour = 12;  // of the clock, [0, 24]
  double zone = 0;   // hours that the clock is ahead of UTC, summer time included
};

struct SunPosition {
  double elevation = 0;         // degrees above the horizon, of the disc's centre as refraction shows it
  double azimuth = 0;           // degrees from north over east, [0, 360)
  double declination = 0;       // degrees
  double equation_of_time = 0;  // minutes that a sundial is ahead of the mean sun
  double day_angle = 0;         // radians since 1 January, a year around: for the distance of the sun
};

/// Good to 0.01 degrees from 1950 to 2050, to 0.1 for centuries around. [Michalsky 1988, The Astronomical Almanac's
/// algorithm]
SunPosition sun_position(const PlaceAndTime& at);

}  // namespace radfarm
