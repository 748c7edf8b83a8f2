#pragma once

namespace radfarm {

/// Sky luminance relative to the zenith's and the illuminances of sun and sky: formulas, sources and checks in
/// docs/sky.md.

/// The 15 sky types of ISO 15469 (CIE S 011), and 16: the CIE overcast sky of Moon and Spencer, (1 + 2 sin elevation)
/// / 3.
inline constexpr int kSkyTypes = 16;

/// Of the sky's element at `zenith_angle`, when the sun is at `sun_zenith_angle` and `from_sun` away from the element;
/// all in radians. 1 at the zenith. Requires: 1 <= type <= kSkyTypes, zenith_angle <= pi / 2.
double relative_luminance(int type, double zenith_angle, double sun_zenith_angle, double from_sun);

enum class Cloudiness { kClear, kPartlyCloudy, kOvercast };
/// Of the groups of sky types: 1 to 5 and 16, 6 to 10, 11 to 15.
Cloudiness cloudiness(int type);

/// Relative optical air mass. [Kasten and Young 1989] Elevation in degrees, at least 0.
double air_mass(double elevation);

/// Illuminance outside the air on a surface facing the sun, lux: 127500 times the square of the mean over the true
/// distance.
double extraterrestrial_illuminance(double day_angle);

/// Of the sun on a surface facing it, lux; 0 below the horizon and behind an overcast. [IES RP-21; Gillette, Pierpoint
/// and Treado 1984] With a `turbidity` above 0 instead by that luminous turbidity factor. [Darula and Kittler 2002]
double sun_illuminance(Cloudiness clouds, double elevation, double extraterrestrial, double turbidity);

/// Of the sky on the ground, lux. [IES RP-21] Below the horizon it falls off over the 3.4 lux of civil and the 0.008
/// lux of nautical twilight to 0 at the astronomical one's end, -18 degrees.
double sky_illuminance(Cloudiness clouds, double elevation);

}  // namespace radfarm
