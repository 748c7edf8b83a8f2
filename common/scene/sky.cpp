#include "scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scene/daylight.h"
#include "scene/latlong.h"
#include "scene/sky_parameters.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kDegree = kPiD / 180;
constexpr std::uint32_t kWidth = 512, kHeight = 256;
constexpr double kSunRadius = 0.533 / 2 * kDegree;

struct Sun {
  double elevation = 0;         // degrees
  double azimuth = 0;           // degrees
  double extraterrestrial = 0;  // lux on a surface facing it, outside the air
};

/// Unit, towards a point of the sky.
Vec3d towards(double elevation, double azimuth, double north) {
  return direction_at({(azimuth + north) * kDegree, (90 - elevation) * kDegree});
}

Sun find_sun(const SkyParameters& sky) {
  constexpr double kAtMeanDistance = 127'500;  // lux
  if (!sky.at) return {sky.elevation, sky.azimuth, kAtMeanDistance};
  const SunPosition position = sun_position(*sky.at);
  return {position.elevation, position.azimuth, extraterrestrial_illuminance(position.day_angle)};
}

/// What a row of texels of radiance 1 brings to the ground: the integral of its tent between the rows beside it times
/// the cosine from straight up, around the sky. By Gauss, four points a half cell, which is exact to rounding.
double ground_share(std::uint32_t row) {
  constexpr std::array kNodes = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr std::array kWeights = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double step = kPiD / kHeight, middle = (row + 0.5) * step;
  double sum = 0;
  for (int half = -2; half < 2; ++half) {
    const double begin = middle + half * step / 2;
    // Above the first row's middle it is alone; the horizon is an edge of cells.
    if (begin < -step / 4 || begin >= kPiD / 2 - step / 4) continue;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const double angle = begin + (kNodes[i] + 1) * step / 4;
      const double tent = row == 0 && angle < middle ? 1 : 1 - std::fabs(angle - middle) / step;
      sum += kWeights[i] * step / 4 * tent * std::cos(angle) * std::sin(angle);
    }
  }
  return 2 * kPiD * sum;
}

double sky_luminance(const SkyParameters& sky, const Vec3d& sun, double sun_zenith_angle, const LatLong& place) {
  if (sky.is_uniform) return 1;
  const double cosine = std::clamp(dot(direction_at(place), sun), -1.0, 1.0);
  return relative_luminance(sky.type, place.colatitude, sun_zenith_angle, std::acos(cosine));
}

/// The upper half relative to the zenith: each texel the mean of two by two places.
std::vector<double> relative_sky(const SkyParameters& sky, const Sun& sun) {
  const double elevation = std::max(0.0, sun.elevation);
  const Vec3d direction = towards(elevation, sun.azimuth, sky.north);
  std::vector<double> luminances;
  for (std::uint32_t row = 0; row < kHeight / 2; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column) {
      double sum = 0;
      for (int i = 0; i < 4; ++i) {
        const LatLong place{2 * kPiD * (column + 0.25 + 0.5 * (i % 2)) / kWidth,
                            kPiD * (row + (i < 2 ? 0.25 : 0.75)) / kHeight};
        sum += sky_luminance(sky, direction, (90 - elevation) * kDegree, place) / 4;
      }
      luminances.push_back(sum);
    }
  }
  return luminances;
}

/// Scales the sky so that it brings `sky_lux` to the ground together with what interpolation lets shine over the
/// horizon.
Environment assemble(const std::vector<double>& sky, double sky_lux, double ground) {
  Environment environment;
  environment.width = kWidth;
  environment.height = kHeight;
  double unscaled = 0;
  for (std::size_t i = 0; i < sky.size(); ++i) {
    unscaled += sky[i] * ground_share(static_cast<std::uint32_t>(i / kWidth)) / kWidth;
  }
  const double leaked = ground * ground_share(kHeight / 2);
  const double scale = std::max(0.0, sky_lux - leaked) / unscaled;
  for (const double luminance : sky) environment.radiance.push_back(Spectrum(static_cast<float>(luminance * scale)));
  environment.radiance.resize(std::size_t{kWidth} * kHeight, Spectrum(static_cast<float>(ground)));
  return environment;
}

void add_sun(const Vec3d& direction, double lux, Environment& environment) {
  environment.sun.direction = to_float(direction);
  environment.sun.cos_radius = static_cast<float>(std::cos(kSunRadius));
  // A disc of radiance L gives pi L sin^2 of its radius: the radius that the float has kept.
  const double cosine = static_cast<double>(environment.sun.cos_radius);
  environment.sun.radiance = Spectrum(static_cast<float>(lux / (kPiD * (1 - cosine) * (1 + cosine))));
}

struct Levels {
  double sun_lux = 0;
  double sky_lux = 0;
};

Result<Levels> find_levels(const SkyParameters& sky, const Sun& sun) {
  const Cloudiness clouds = cloudiness(sky.type);
  Levels levels;
  levels.sky_lux = sky.luminance ? kPiD * *sky.luminance : sky.sky_lux.value_or(sky_illuminance(clouds, sun.elevation));
  const double model =
      sky.is_uniform ? 0 : sun_illuminance(clouds, sun.elevation, sun.extraterrestrial, sky.turbidity.value_or(0));
  levels.sun_lux = sky.sun_lux.value_or(model);
  const std::string where = "the sun's elevation is " + std::to_string(sun.elevation).substr(0, 6) + " degrees";
  if (levels.sun_lux > 0 && sun.elevation <= 0) {
    return fail(Code::kInvalidArgument, "sky: sun_lux= is given, but " + where + ": not above the horizon");
  }
  if (levels.sun_lux > 0 || levels.sky_lux > 0) return levels;
  return fail(Code::kFailedPrecondition, "sky: nothing shines: " + where + "; give sky_lux=, or another time");
}

}  // namespace

Result<Environment> make_sky(std::string_view parameters) {
  RADFARM_TRY(const SkyParameters sky, parse_sky(parameters));
  const Sun sun = find_sun(sky);
  RADFARM_TRY(const Levels levels, find_levels(sky, sun));
  const Vec3d direction = towards(sun.elevation, sun.azimuth, sky.north);
  const double on_ground = levels.sky_lux + levels.sun_lux * std::max(0.0, direction.y);
  Environment environment = assemble(relative_sky(sky, sun), levels.sky_lux, sky.ground / kPiD * on_ground);
  if (levels.sun_lux > 0) add_sun(direction, levels.sun_lux, environment);
  return environment;
}

}  // namespace radfarm
