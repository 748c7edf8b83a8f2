#pragma once

#include "math/spectrum.h"
#include "scene/world.h"

namespace radfarm {

/// A surface as light on its way from the emitters meets it.
struct LightVertex {
  SurfacePoint point;
  Vec3 in;              // unit, back along the path
  Spectrum straight{};  // what a pane passes on; black elsewhere
  Bsdf bsdf;            // the last: making it sets the others

  LightVertex(const World& world, const Hit& hit, const Vec3& back);

 private:
  Bsdf scattering(const World& world, const Hit& hit);
};

/// What a surface sends on: a direction, and of each unit of power that arrives, how much of it.
struct ScatteredLight {
  Ray ray;
  Spectrum weight;
  bool is_specular = false;
  bool is_straight = false;  // through a pane
};

/// Uniform random numbers of one vertex.
struct ScatteringNumbers {
  float part = 0;
  float lobe = 0;
  Vec2 way{0, 0};
};

/// One of the parts that send light of this colour on (diffuse, specular, straight through a pane), chosen by what they
/// send; its weight is divided by the probability. Shading normals bend light so that its power is kept. [Veach 1997,
/// 5.3]                                                                                     docs/pipeline.md (paths.1)
ScatteredLight scatter_light(const LightVertex& vertex, const Spectrum& power, const ScatteringNumbers& numbers);

}  // namespace radfarm
