#pragma once

#include <cstdint>
#include <vector>

#include "math/sampling.h"
#include "scene/environment_light.h"
#include "scene/photometry.h"
#include "scene/shining.h"
#include "scene/surface.h"

namespace radfarm {

/// One triangle that emits, in world space, counter-clockwise from its front.
struct EmissiveTriangle {
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  TriangleVertices vertices;
  Vec3 normal;                 // unit, front
  float area = 0;              // m^2
  Spectrum mean_radiance;      // over the texture on the triangle
  bool both_sides = false;
};

/// A punctual light with its photometry; an IES light of any kind but directional shines as its table says.
struct PunctualEmitter : PunctualLight {
  const Photometry* table = nullptr;  // the scene's; null: even, or a spot's cones
  PhotometrySampler sampler;          // of the table
};

/// Everything in a scene that gives light, and how to choose one: with probability 0.9 by luminous power, else uniformly,
/// so that a lamp that is weak against the others is still found when it is the only one in its room (ALGORITHMS H37).
struct Emitters {
  std::vector<EmissiveTriangle> triangles;
  std::vector<PunctualEmitter> punctual;
  bool has_environment = false;
  std::vector<std::uint32_t> light_of_punctual;  // each one's index in the scene
  DiscreteDistribution choice;           // over triangles, then punctual lights, then the environment
  std::vector<double> flux;              // lm, of each of these
  double total_flux = 0;                 // lm, of all
  std::size_t declared_triangles = 0;    // of materials that emit or are switched off

  std::size_t size() const { return triangles.size() + punctual.size() + (has_environment ? 1 : 0); }
  /// The triangle's index in `triangles`, or kNone.
  std::uint32_t find(std::uint32_t instance, std::uint32_t triangle) const;

  std::vector<std::uint32_t> first_of_instance;  // into `slot`, kNone when the instance does not emit
  std::vector<std::uint32_t> slot;               // per triangle of emitting instances
};

/// Collects the emitters that shine. Zero-power ones are left out of `triangles` but counted. `radius` is the scene's: a
/// directional light counts with what passes through a disk that large, and so does the environment. Borrows the scene's
/// photometries. Cost: O(emissive triangles).
Emitters find_emitters(const Surfaces& surfaces, const EnvironmentLight& environment, float radius, const Shining& shining = {});

/// What a point, spot or IES light sends in unit direction `way`, cd.
Spectrum intensity(const PunctualEmitter& light, const Vec3& way);

/// Irradiance per unit cosine, lux, that a punctual light gives at `point` unoccluded, and the direction to it.
struct PunctualArrival {
  Spectrum irradiance;
  Vec3 direction{0, 0, 1};  // unit, towards the light
  Vec3 target{0, 0, 0};     // where a visibility ray ends
};
PunctualArrival arrive(const PunctualEmitter& light, const Vec3& point, float scene_radius);

}  // namespace radfarm
