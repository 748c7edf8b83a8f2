#pragma once

#include <cstdint>
#include <optional>

#include "base/progress.h"
#include "effects/pilot.h"
#include "effects/specular_share.h"
#include "effects/trapped_light.h"
#include "scene/world.h"

namespace radfarm {

/// What the effects plan decides on: counted from the scene, or measured by a pilot of a few thousand rays.
struct Measurements {
  // Light
  std::size_t emissive_triangles = 0;      // declared
  std::size_t punctual_lights = 0;
  bool has_environment = false;            // a map or a sky is given
  double emitted_flux = 0;                 // lm
  float max_radiance = 0;                  // of any triangle or the sky, cd/m^2
  float flux_color_deviation = 0;          // of any emitter's colour from that of all light: max channel ratio - 1
  std::size_t dark_channels = 0;           // of 3, in which nothing is emitted
  float ies_contrast = 0;                  // (I_max - I_mean) / I_mean of any IES table
  std::size_t ies_lights = 0;
  // Matter of the materials that are used
  float max_reflectance = 0;               // largest channel of any base colour, textures taken as 1
  float color_deviation = 0;               // largest relative deviation of a reflectance's channel from its luminance
  float max_specular = 0;                  // largest mean reflectance of the specular layers, textures taken as 1
  std::size_t metals = 0, glossy = 0, mirrors = 0, coats = 0, mirror_coats = 0, sheens = 0, anisotropic = 0;  // materials
  std::size_t volumes = 0, panes = 0, rough_transmitters = 0;
  std::size_t dispersive = 0, iridescent = 0, scattering = 0;  // not simulated
  float max_transmission = 0;
  float least_coverage = 1;                // of any texel or vertex of a material with alpha
  float texture_deviation = 0;             // |rho - mean rho| of any texel of a base texture, times the colour
  float emission_contrast = 0;             // |L - mean L| of any texel of an emission texture, cd/m^2
  float normal_map_angle = 0;              // largest, degrees
  std::size_t reflectance_textures = 0, emission_textures = 0, normal_maps = 0;
  double detail_elevation = 1;             // of the visible threshold, by what the camera sees: mean, 1 to kMaxElevation
  SpecularShares specular;                 // of the light that diffuse surfaces reflect
  Pilot pilot;
  std::optional<TrappedLight> trapped;     // light that can never be lost
};

/// Detail raises the threshold of what is visible by so much at most.
inline constexpr float kMaxElevation = 10;

/// What of a view: its camera and its size in pixels.
struct ViewSize {
  const Camera& camera;
  int width = 0;
  int height = 0;
};

/// Cost: O(materials + texels) and the pilot's rays.
Measurements measure(const World& world, const ViewSize& view, std::uint64_t seed, const Progress& progress = {});

}  // namespace radfarm
