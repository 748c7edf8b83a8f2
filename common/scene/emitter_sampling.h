#pragma once

#include "math/vec.h"
#include "scene/world.h"

namespace radfarm {

/// Chooses an emitter and a direction towards it: next-event estimation.              docs/pipeline.md (path.3)

/// What one next-event sample brings to a surface point: radiance arriving from `direction`, divided by the probability
/// of having chosen it; black when nothing arrives.
struct NextEvent {
  Spectrum weight;       // L / pdf for triangles and sky, I / d^2 / probability for punctual lights (both without receiver cosine)
  Vec3 direction{0, 0, 1};  // unit
  float pdf = 0;         // per steradian, of triangles and sky; 0 for punctual lights, which no path hits
  bool traced = false;   // whether it took a visibility ray
};

/// Samples the light that reaches `point` from one emitter, with its visibility. One shadow ray at most. Light from behind
/// the surface counts only where `sees_behind`: for what transmits.
NextEvent sample_emitter(const World& world, const SurfacePoint& point, float choice, const Vec2& u,
                         bool sees_behind = false);

/// Where a visibility ray towards the sky ends: outside all that is in the scene.
Vec3 beyond_scene(const World& world, const Vec3& start, const Vec3& direction);

/// Solid-angle density with which sample_emitter() at `from` chooses the direction to a point of emissive triangle `index`,
/// which lies at distance `distance` along unit `direction`.
float pdf_emitter(const World& world, std::uint32_t index, const Vec3& from, const Vec3& direction, float distance);

/// (path.2) The share of what a hit emits that belongs to a direction chosen with density `pdf` per steradian at `from`, when
/// sample_emitter() is used beside it: the balance heuristic. 1 where next events never choose the triangle.
float balance_of_hit(const World& world, const Hit& hit, const Vec3& from, const Vec3& direction, float pdf);

/// The same of radiance from the environment where a ray met nothing.
float balance_of_sky(const World& world, const Vec3& direction, float pdf);

/// The share of a next event beside directions chosen with density `other` per steradian.
inline float balance_of_event(const NextEvent& event, float other) {
  return event.pdf > 0 ? event.pdf / (event.pdf + other) : 1;
}

}  // namespace radfarm
