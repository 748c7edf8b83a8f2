#pragma once

#include "math/vec.h"
#include "scene/ray_caster.h"
#include "scene/world.h"

namespace radfarm {

/// Light on its way from an emitter: the start of a light path.                       docs/pipeline.md (emission.1)
struct EmittedRay {
  Ray ray;         // unit direction, off the emitter's surface
  Spectrum power;  // lm, divided by the probability of this emitter: its mean over random numbers is the flux emitted
  Vec3 plane{0, 0, 0};  // unit normal of the emitting surface, on the side of the ray; zero: points, directions, sky
};

/// Chooses an emitter as sample_emitter() does, then a ray of its light: from triangles evenly by area and by the cosine, from
/// points and spots evenly over the directions that they light, from IES lights by their tables, from directional lights and
/// the sky parallel, over the disk that the scene's bounding sphere fills. `choice`, `place` and `direction` are uniform random numbers. Requires: emitters.size() > 0.
EmittedRay sample_emission(const World& world, double choice, const Vec2& place, const Vec2& direction);

}  // namespace radfarm
