#include "estimate/scattering.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

namespace radfarm {
namespace {

/// Whether the shading and the geometric normal agree on which side a direction lies: otherwise light would leak.
bool sides_agree(const SurfacePoint& point, const Vec3& direction) {
  return dot(point.shading_normal, direction) * dot(point.geometric_normal, direction) > 0;
}

Continuation continuation(const Vertex& vertex, const Bsdf::Sample& sample, float share, bool is_specular) {
  if (is_black(sample.weight) || !sides_agree(vertex.point, sample.direction)) return {};
  const float pdf = share * sample.pdf;
  return {{leave(vertex.point, sample.direction), sample.direction, scatter(vertex.point.cone, pdf, sample.is_delta)},
          sample.weight / share,
          {vertex.point.position, sample.direction, pdf, sample.is_delta},
          is_specular};
}

}  // namespace

Vertex one_way_vertex(const World& world, const SurfacePoint& point, const Bsdf& bsdf) {
  if (!bsdf.has_specular()) return {world, point, bsdf, 1, 0};
  if (!bsdf.has_diffuse()) return {world, point, bsdf, 0, 1};
  const float specular = luminance(bsdf.specular_albedo()), diffuse = luminance(bsdf.diffuse_reflectance());
  // Neither is starved: an albedo is a mean, and a highlight may be all that is seen.
  const float share = std::clamp(specular / std::max(specular + diffuse, 1e-12F), 0.1F, 0.9F);
  return {world, point, bsdf, 1 - share, share};
}

Spectrum weighed_emission(const World& world, const Departure& from, const Hit& hit, const SurfacePoint& point) {
  const Spectrum emitted = world.emission(point);
  if (from.is_delta || is_black(emitted)) return emitted;
  return emitted * balance_of_hit(world, hit, from.position, from.direction, from.pdf);
}

Spectrum weighed_sky(const World& world, const Departure& from) {
  if (world.environment.is_empty()) return {};
  const Spectrum radiance = world.environment.radiance(from.direction);
  return from.is_delta || is_black(radiance) ? radiance : radiance * balance_of_sky(world, from.direction, from.pdf);
}

NextEventLight next_event_light(const Vertex& vertex, float choice, const Vec2& u, Counters& counters) {
  const Bsdf& bsdf = vertex.bsdf;
  if (bsdf.is_delta()) return {};
  const NextEvent event = sample_emitter(vertex.world, vertex.point, choice, u, bsdf.transmits());
  counters.visibility_rays += event.traced ? 1 : 0;
  if (is_black(event.weight)) return {};
  const float cosine = dot(vertex.point.shading_normal, event.direction);
  NextEventLight light;
  if (bsdf.has_diffuse() && cosine > 0) {
    const float other = vertex.diffuse_share * cosine * kInversePi;
    light.diffuse = bsdf.eval_diffuse(event.direction) * event.weight * (balance_of_event(event, other) * cosine);
  }
  if (bsdf.has_specular()) {
    const float other = vertex.specular_share * bsdf.pdf_specular(event.direction);
    light.specular =
        bsdf.eval_specular(event.direction) * event.weight * (balance_of_event(event, other) * std::fabs(cosine));
  }
  return light;
}

Continuation go_on_diffuse(const Vertex& vertex, const Vec2& u) {
  const Vec3 local = sample_cosine_hemisphere(u);
  Bsdf::Sample sample;
  sample.direction = normalize(Frame(vertex.point.shading_normal).to_world(local));
  sample.pdf = pdf_cosine_hemisphere(local);
  sample.weight = vertex.bsdf.diffuse_reflectance() * vertex.bsdf.diffuse_shape(sample.direction);
  return continuation(vertex, sample, vertex.diffuse_share, false);
}

Continuation go_on_specular(const Vertex& vertex, float choice, const Vec2& u) {
  return continuation(vertex, vertex.bsdf.sample_specular(choice, u), vertex.specular_share, true);
}

Continuation go_on(const Vertex& vertex, float choice, const Vec2& u) {
  if (choice >= vertex.specular_share) return go_on_diffuse(vertex, u);
  return go_on_specular(vertex, choice / vertex.specular_share, u);
}

}  // namespace radfarm
