#pragma once

#include <cstdint>

#include "scene/camera.h"
#include "scene/world.h"

namespace radfarm {

/// What a few thousand camera rays and the diffuse walks that go on from them found.
struct Pilot {
  std::uint32_t rays = 0;           // camera rays
  std::uint32_t hits = 0;           // ... that met a surface
  double direct_radiance = 0;       // mean over camera rays of reflected direct light, cd/m^2
  double met_radiance = 0;          // the same, mean over surfaces that diffuse rays met
  double specular_share = 0;        // mean over camera rays of what the specular part scatters, luminance
  float max_blur = 0;               // of a lens, in pixels: diameter of the circle of confusion
  std::uint32_t bounces = 0;        // rays from diffuse surfaces ...
  std::uint32_t met = 0;            // ... that met a surface that reflects
  std::uint32_t walks = 0;          // of up to 8 bounces, from the camera or, where it sees nothing, from emitters ...
  std::uint32_t escaped = 0;        // ... that met nothing on the way

  /// Upper end of a one-sided 95 % interval of the probability that a diffuse ray meets what reflects.
  double meets_at_most() const;
  double escapes_at_most() const;
};

/// Cost: about 10 rays for each of 4096 camera rays.
Pilot run_pilot(const World& world, const Camera& camera, int width, int height, std::uint64_t seed);

}  // namespace radfarm
