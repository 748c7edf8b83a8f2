#pragma once

#include <cstdint>

#include "scene/surface.h"
#include "senders/vertex_senders.h"

namespace radfarm {

/// What a camera ray meets first, panes looked through: an integrator that is given one fills it for the AOVs.
struct FirstSurface {
  bool is_seen = false;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 0};       // unit shading normal, on the viewer's side
  Spectrum albedo;            // reflectance of the diffuse part
  Spectrum irradiance;        // lux that reaches the diffuse part, less what the layers above it keep; 0 where there is none
  std::uint32_t cell = kNone;    // of the grid
  std::uint32_t vertex = kNone;  // of the grid, that stood for the point
  SenderClasses classes;         // of that vertex
  float threshold = 0;           // of that vertex, cd/m^2
};

inline FirstSurface first_surface(const SurfacePoint& point, const Bsdf& bsdf, const Spectrum& irradiance) {
  return {true, point.position, point.shading_normal, bsdf.diffuse_reflectance(), irradiance, kNone, kNone, {}};
}

}  // namespace radfarm
