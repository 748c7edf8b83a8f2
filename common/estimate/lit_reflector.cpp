#include "estimate/lit_reflector.h"

#include <algorithm>

#include "scene/emitter_sampling.h"

namespace radfarm {

const Reflector* reflector_at(const GatherContext& context, const Hit& hit, const SurfacePoint& met) {
  const std::uint32_t id = context.lookup.find(hit, met);
  return id == kNone ? nullptr : &context.tree.reflectors[id];
}

Spectrum radiance_at(const GatherPoint& point, const Reflector& reflector, const SurfacePoint& met, const Vec3& way,
                     std::uint32_t dimension) {
  const World& world = point.context.world;
  ++point.counters.visibility_rays;
  const NextEvent event = sample_emitter(world, met, point.sampler.one(dimension), point.sampler.two(dimension + 1));
  const float cosine = std::max(0.0F, dot(met.shading_normal, event.direction));
  const Spectrum rho = world.surfaces.reflectance(met, -dot(met.shading_normal, way));
  const Spectrum rest = reflector.radiance - reflector.of_direct;
  const Spectrum indirect(std::max(0.0F, rest.r), std::max(0.0F, rest.g), std::max(0.0F, rest.b));  // rounding
  return indirect + rho * event.weight * (cosine * kInversePi);
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
