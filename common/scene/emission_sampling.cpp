#include "scene/emission_sampling.h"

#include <cmath>

#include "math/sampling.h"

namespace radfarm {
namespace {

EmittedRay emit_from_triangle(const World& world, const EmissiveTriangle& t, Vec2 place, const Vec2& direction) {
  const bool is_back = t.both_sides && place.x < 0.5F;
  if (t.both_sides) place.x = is_back ? 2 * place.x : 2 * place.x - 1;
  const Vec3 b = sample_uniform_triangle(place);
  const bool is_mirrored = world.surfaces.is_mirrored(t.instance);
  SurfacePoint point = world.surfaces.at({t.instance, t.triangle, is_mirrored ? b.z : b.y, is_mirrored ? b.y : b.z, 0});
  if (is_back) face(point, -point.geometric_normal);
  const Vec3 way = Frame(point.geometric_normal).to_world(sample_cosine_hemisphere(direction));
  const Spectrum power = world.emission(point) * (kPi * t.area * (t.both_sides ? 2.0F : 1.0F));
  return {{leave(point), normalize(way)}, power, point.geometric_normal};
}

/// Light of one direction over the disk that the scene's sphere fills. `irradiance`: of a surface that faces it, lux.
EmittedRay emit_parallel(const World& world, const Vec3& way, const Spectrum& irradiance, const Vec2& place) {
  const Vec2 disk = sample_uniform_disk(place) * world.radius;
  const Vec3 across = Frame(way).to_world(Vec3(disk.x, disk.y, 0));
  return {{across - way * (2 * world.radius), way}, irradiance * (kPi * world.radius * world.radius)};
}

EmittedRay emit_from_sky(const World& world, double choice, const Vec2& place, const Vec2& direction) {
  const EnvironmentLight::Sample sky = world.environment.sample(choice, direction);
  return emit_parallel(world, -sky.direction, sky.pdf > 0 ? sky.radiance / sky.pdf : Spectrum(), place);
}

EmittedRay emit_from_light(const World& world, const PunctualEmitter& light, const Vec2& place, const Vec2& direction) {
  if (light.kind == PunctualLight::Kind::kDirectional) return emit_parallel(world, light.direction, light.intensity, place);
  if (light.table != nullptr) {
    const PhotometrySampler::Sample sample = light.sampler.sample(direction, light);
    return {{light.position, sample.way}, intensity(light, sample.way) / sample.pdf};
  }
  // The sphere's cap around the light's direction: all of it for a point.
  const bool is_spot = light.kind == PunctualLight::Kind::kSpot;
  const float least = is_spot ? light.cos_outer : -1;
  const float cosine = 1 - direction.x * (1 - least);
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine)), angle = 2 * kPi * direction.y;
  const Vec3 axis = is_spot ? light.direction : Vec3(0, 0, 1);
  const Vec3 way = normalize(Frame(axis).to_world(Vec3(sine * std::cos(angle), sine * std::sin(angle), cosine)));
  return {{light.position, way}, intensity(light, way) * (2 * kPi * (1 - least))};
}

}  // namespace

EmittedRay sample_emission(const World& world, double choice, const Vec2& place, const Vec2& direction) {
  const Emitters& emitters = world.emitters;
  const auto chosen = emitters.choice.sample(choice);
  const std::size_t light = chosen.index - emitters.triangles.size();  // wraps around for triangles
  EmittedRay emitted;
  if (chosen.index < emitters.triangles.size()) {
    emitted = emit_from_triangle(world, emitters.triangles[chosen.index], place, direction);
  } else if (light < emitters.punctual.size()) {
    emitted = emit_from_light(world, emitters.punctual[light], place, direction);
  } else {
    // The sky is the last: what is left of the number that chose it chooses in it.
    const double left = std::clamp((choice - (1 - chosen.probability)) / chosen.probability, 0.0, 0x1.fffffffffffffp-1);
    emitted = emit_from_sky(world, left, place, direction);
  }
  emitted.power *= static_cast<float>(1 / chosen.probability);
  return emitted;
}

}  // namespace radfarm
