#pragma once

#include <optional>
#include <string_view>

#include "base/status.h"
#include "scene/sun_position.h"

namespace radfarm {

/// What `--env sky:...` says.                                                          docs/sky.md
struct SkyParameters {
  std::optional<PlaceAndTime> at;  // else the sun's direction is given
  double elevation = 45;           // degrees, of the sun
  double azimuth = 180;            // degrees, from north over east
  bool is_uniform = false;
  int type = 12;                    // of the CIE's sky types, if not uniform
  std::optional<double> turbidity;  // luminous turbidity factor
  std::optional<double> sun_lux;    // on a surface facing the sun
  std::optional<double> sky_lux;    // of the sky alone on the ground
  std::optional<double> luminance;  // of a uniform sky, cd/m^2
  double ground = 0.2;              // albedo
  double north = 0;                 // degrees from -z towards +x
};

Result<SkyParameters> parse_sky(std::string_view text);

}  // namespace radfarm
