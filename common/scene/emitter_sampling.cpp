#include "scene/emitter_sampling.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

// Below the first bound area sampling is as good and cheaper, above the second Arvo's formulas lose their digits.
bool by_solid_angle(double omega) {
  return omega >= SphericalTriangle::kMinSolidAngle && omega <= SphericalTriangle::kMaxSolidAngle;
}

double solid_angle_from(const EmissiveTriangle& t, const Vec3& from) {
  const Vec3d origin = to_double(from);
  return triangle_solid_angle(to_double(t.vertices[0]) - origin, to_double(t.vertices[1]) - origin,
                              to_double(t.vertices[2]) - origin);
}

/// Density per steradian of a point chosen uniformly by area.
float area_pdf(const EmissiveTriangle& t, const Vec3& direction, float distance) {
  const float cosine = std::fabs(dot(t.normal, direction));
  return cosine > 0 ? distance * distance / (cosine * t.area) : 0;
}

/// A point of the triangle as barycentric weights of vertices 1 and 2.
Vec2 sample_point(const EmissiveTriangle& t, const Vec3& from, const Vec2& u) {
  if (!by_solid_angle(solid_angle_from(t, from))) {
    const Vec3 b = sample_uniform_triangle(u);
    return {b.y, b.z};
  }
  const SphericalTriangle spherical(to_double(t.vertices[0]), to_double(t.vertices[1]), to_double(t.vertices[2]),
                                    to_double(from));
  const Vec3 b = spherical.sample(u).barycentrics;
  return {b.y, b.z};
}

/// The triangle's vertices in file order, as Hit counts them.
Hit hit_on(const World& world, const EmissiveTriangle& t, const Vec2& b) {
  const bool is_swapped = world.surfaces.is_mirrored(t.instance);
  return {t.instance, t.triangle, is_swapped ? b.y : b.x, is_swapped ? b.x : b.y, 0};
}

/// Whether the geometric and the shading normal agree on which side light comes from, and light from there counts.
bool is_open(const SurfacePoint& point, const Vec3& direction, bool sees_behind) {
  const float geometric = dot(point.geometric_normal, direction), shading = dot(point.shading_normal, direction);
  return (geometric > 0 && shading > 0) || (sees_behind && geometric < 0 && shading < 0);
}

NextEvent sample_triangle(const World& world, const SurfacePoint& point, std::uint32_t index, const Vec2& u,
                          bool sees_behind) {
  const EmissiveTriangle& t = world.emitters.triangles[index];
  SurfacePoint target = world.surfaces.at(hit_on(world, t, sample_point(t, point.position, u)));
  // A target in the point's own plane lies on either side by rounding: only what sees behind may start there.
  const Vec3 start = sees_behind ? leave(point, target.position - point.position) : leave(point);
  const Vec3 offset = target.position - start;
  const float distance = length(offset);
  if (!(distance > 0)) return {};
  NextEvent event;
  event.direction = offset / distance;
  face(target, -event.direction);
  if (!is_open(point, event.direction, sees_behind)) return {};
  const Spectrum radiance = world.emission(target);
  event.pdf = pdf_emitter(world, index, point.position, event.direction, distance);
  if (is_black(radiance) || !(event.pdf > 0)) return {};
  event.traced = true;
  event.weight = radiance * world.caster.transmittance(start, leave(target)) / event.pdf;
  return event;
}

NextEvent sample_punctual(const World& world, const SurfacePoint& point, const PunctualEmitter& light, float probability,
                          bool sees_behind) {
  const PunctualArrival arrival = arrive(light, point.position, world.radius);
  if (is_black(arrival.irradiance) || !is_open(point, arrival.direction, sees_behind)) return {};
  NextEvent event;
  event.traced = true;
  event.direction = arrival.direction;
  event.weight = arrival.irradiance *
                 world.caster.transmittance(leave(point, arrival.direction), arrival.target) / probability;
  return event;
}

float sky_probability(const World& world) {
  return static_cast<float>(world.emitters.choice.probability(world.emitters.size() - 1));
}

NextEvent sample_sky(const World& world, const SurfacePoint& point, float probability, float choice, const Vec2& u,
                     bool sees_behind) {
  const EnvironmentLight::Sample sky = world.environment.sample(static_cast<double>(choice), u);
  NextEvent event;
  event.direction = sky.direction;
  event.pdf = probability * sky.pdf;
  if (is_black(sky.radiance) || !(event.pdf > 0) || !is_open(point, sky.direction, sees_behind)) return {};
  event.traced = true;
  const Vec3 start = leave(point, sky.direction);
  event.weight = sky.radiance * world.caster.transmittance(start, beyond_scene(world, start, sky.direction)) / event.pdf;
  return event;
}

}  // namespace

Vec3 beyond_scene(const World& world, const Vec3& start, const Vec3& direction) {
  return start + direction * (2 * (world.radius + length(start)));
}

NextEvent sample_emitter(const World& world, const SurfacePoint& point, float choice, const Vec2& u, bool sees_behind) {
  const Emitters& emitters = world.emitters;
  if (emitters.size() == 0) return {};
  const auto chosen = emitters.choice.sample(choice);
  const auto probability = static_cast<float>(chosen.probability);
  if (chosen.index < emitters.triangles.size()) {
    return sample_triangle(world, point, static_cast<std::uint32_t>(chosen.index), u, sees_behind);
  }
  const std::size_t light = chosen.index - emitters.triangles.size();
  if (light < emitters.punctual.size()) {
    return sample_punctual(world, point, emitters.punctual[light], probability, sees_behind);
  }
  // What is left of the number that chose the sky, which is the last, chooses in it.
  const float left = std::min((choice - (1 - probability)) / probability, 0x1.fffffep-1F);
  return sample_sky(world, point, probability, std::max(0.0F, left), u, sees_behind);
}

float pdf_emitter(const World& world, std::uint32_t index, const Vec3& from, const Vec3& direction, float distance) {
  const EmissiveTriangle& t = world.emitters.triangles[index];
  const auto choice = static_cast<float>(world.emitters.choice.probability(index));
  const double omega = solid_angle_from(t, from);
  if (by_solid_angle(omega)) return choice / static_cast<float>(omega);
  return choice * area_pdf(t, direction, distance);
}

float balance_of_hit(const World& world, const Hit& hit, const Vec3& from, const Vec3& direction, float pdf) {
  const std::uint32_t index = world.emitters.find(hit.instance, hit.triangle);
  if (index == kNone) return 1;
  return pdf / (pdf + pdf_emitter(world, index, from, direction, hit.distance));
}

float balance_of_sky(const World& world, const Vec3& direction, float pdf) {
  return pdf / (pdf + sky_probability(world) * world.environment.pdf(direction));
}

}  // namespace radfarm
