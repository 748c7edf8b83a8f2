#pragma once

#include <cstdint>

#include "scene/world.h"

namespace radfarm {

/// What the effects plan decides on: counted from the scene, or probed with a few thousand rays.
struct Measurements {
  std::size_t emissive_triangles = 0;      // declared
  std::size_t punctual_lights = 0;
  double emitted_flux = 0;                 // lm
  float max_radiance = 0;                  // of any emitter, cd/m^2
  float max_reflectance = 0;               // largest channel of any material, textures taken as 1
  float min_reflectance = 1;               // smallest channel of any material without texture; 0 with one
  std::size_t glossy_materials = 0;        // folded into diffuse
  std::size_t cutout_meshes = 0;           // meshes whose coverage is below 1 somewhere
  std::size_t reflectance_textures = 0;
  std::size_t emission_textures = 0;
  std::uint32_t probes = 0;                // walks of 8 diffuse bounces from the emitters ...
  std::uint32_t escaped = 0;               // ... that met nothing on the way
};

/// Cost: O(materials) and 8 x `probes` rays.
Measurements measure(const World& world, std::uint64_t seed);

}  // namespace radfarm
