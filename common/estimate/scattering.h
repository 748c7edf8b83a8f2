#pragma once

#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/radiance_parts.h"
#include "scene/emitter_sampling.h"
#include "scene/world.h"

namespace radfarm {

/// One vertex of a path from the camera, and the two things that happen there: light of emitters scattered along the path, and
/// the path going on. The diffuse and the specular part are strategies of their own (path.2).

/// The last vertex that chose a direction by a density, for weighing what the next hit emits.
struct Departure {
  Vec3 position{0, 0, 0};
  Vec3 direction{0, 0, 1};
  float pdf = 0;        // per steradian, the choice between diffuse and specular included
  bool is_delta = true;  // also of camera rays: nothing else finds what they meet
};

/// `diffuse_share`, `specular_share`: probabilities with which a path goes on by each part. They add up to 1 where it goes on by
/// one of them, or are 1 each where it goes on by both.
struct Vertex {
  const World& world;
  const SurfacePoint& point;
  const Bsdf& bsdf;
  float diffuse_share = 1;
  float specular_share = 1;
};

/// Of a path that goes on by one part: the probabilities follow what the parts scatter.
Vertex one_way_vertex(const World& world, const SurfacePoint& point, const Bsdf& bsdf);

/// Emission of a hit, or of the sky where a ray met nothing, weighed against next events.
Spectrum weighed_emission(const World& world, const Departure& from, const Hit& hit, const SurfacePoint& point);
Spectrum weighed_sky(const World& world, const Departure& from);

/// Light that reaches the vertex from one sampled emitter and goes on along the path, by part.
struct NextEventLight {
  Spectrum diffuse;
  Spectrum specular;
};
NextEventLight next_event_light(const Vertex& vertex, float choice, const Vec2& u, Counters& counters);

/// How a path goes on from a vertex; black weight: it ends.
struct Continuation {
  Ray ray;
  Spectrum weight;  // f cos / pdf
  Departure departure;
  bool is_specular = false;
};
/// By the part that `choice` falls on. Requires: a one-way vertex.
Continuation go_on(const Vertex& vertex, float choice, const Vec2& u);
Continuation go_on_diffuse(const Vertex& vertex, const Vec2& u);
/// `choice` is of the lobe.
Continuation go_on_specular(const Vertex& vertex, float choice, const Vec2& u);

}  // namespace radfarm
