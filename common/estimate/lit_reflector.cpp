#include "estimate/lit_reflector.h"

#include <algorithm>
#include <limits>

#include "math/sampling.h"
#include "scene/emitter_sampling.h"

namespace radfarm {

const Reflector* reflector_at(const GatherContext& context, const Hit& hit, const SurfacePoint& met) {
  const std::uint32_t id = context.lookup.find(hit, met);
  return id == kNone ? nullptr : &context.tree.reflectors[id];
}

namespace {

constexpr std::uint32_t kMostRays = 4;  // one after the other
constexpr float kMostOfMean = 32;       // takes .1 % of the light of the peers' office, docs/decisions/0021
constexpr std::uint32_t kDimensionsOfRay = 1U << 25;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Spectrum mean_indirect(const Reflector& reflector) {
  const Spectrum rest = reflector.radiance - reflector.of_direct;
  return {std::max(0.0F, rest.r), std::max(0.0F, rest.g), std::max(0.0F, rest.b)};  // rounding
}

Spectrum next_event_at(const GatherPoint& point, const SurfacePoint& met, std::uint32_t dimension) {
  ++point.counters.visibility_rays;
  const NextEvent event = sample_emitter(point.context.world, met, point.sampler.one(dimension), point.sampler.two(dimension + 1));
  return event.weight * (std::max(0.0F, dot(met.shading_normal, event.direction)) * kInversePi);
}

/// Close to an emitter single next events bring without bound: at most so many times what the patch has.
Spectrum bounded(const Spectrum& direct, const Reflector& reflector) {
  const float most = kMostOfMean * luminance(reflector.radiance), found = luminance(direct);
  return found > most ? direct * (most / found) : direct;
}

/// Radiance that arrives from the surface that one cosine-distributed ray meets, pi times its mean being the irradiance.
Spectrum seen_by_ray(const GatherPoint& point, const SurfacePoint& from, std::uint32_t dimension, std::uint32_t rays) {
  const Vec3 way = normalize(Frame(from.shading_normal).to_world(sample_cosine_hemisphere(point.sampler.two(dimension + 2))));
  if (!(dot(way, from.geometric_normal) > 0)) return {};
  ++point.counters.visibility_rays;
  const auto hit = point.context.world.caster.closest({leave(from), way}, point.sampler.key(dimension + 2), kInfinity);
  if (!hit) return {};
  SurfacePoint met = point.context.world.surfaces.at(*hit);
  face(met, -way);
  const Reflector* reflector = reflector_at(point.context, *hit, met);
  return reflector == nullptr ? Spectrum() : hit->weight * radiance_at(point, *reflector, met, way, dimension, rays);
}

}  // namespace

Spectrum radiance_at(const GatherPoint& point, const Reflector& reflector, const SurfacePoint& met, const Vec3& way,
                     std::uint32_t dimension, std::uint32_t rays) {
  const bool has_event = point.context.settings.next_events != 0, goes_on = reflector.is_doubtful != 0 && rays < kMostRays;
  if (!has_event && !goes_on) return reflector.radiance;
  const Spectrum rho = point.context.world.surfaces.reflectance(met, -dot(met.shading_normal, way));
  const Spectrum direct = has_event ? bounded(rho * next_event_at(point, met, dimension), reflector) : reflector.of_direct;
  return direct + (goes_on ? rho * seen_by_ray(point, met, dimension + kDimensionsOfRay, rays + 1) : mean_indirect(reflector));
}

Spectrum reflected_ratio(const GatherPoint& point, const SenderSample& end, std::uint32_t dimension) {
  const GatherContext& context = point.context;
  if (context.settings.next_events == 0) return Spectrum(1.0F);
  const SenderPatch& patch = context.tree.patches[end.patch];
  const Hit hit = context.world.surfaces.hit_at(patch.instance, patch.triangle, end.position);
  SurfacePoint met = context.world.surfaces.at(hit);
  face(met, patch.normal);
  const Reflector* reflector = reflector_at(context, hit, met);
  if (reflector == nullptr) return Spectrum(1.0F);
  const Spectrum& mean = reflector->radiance;
  const Spectrum here = radiance_at(point, *reflector, met, normalize(end.position - point.surface.position), dimension);
  return {mean.r > 0 ? here.r / mean.r : 1, mean.g > 0 ? here.g / mean.g : 1, mean.b > 0 ? here.b / mean.b : 1};
}

}  // namespace radfarm
