#include "estimate/reflected_light.h"

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

/// The radiance of a reflector with what it has straight from emitters sampled at the very point: who looks at a patch looks at
/// its lit part, and its mean is too dark for that.
Spectrum with_next_event(const GatherContext& context, const Reflector& reflector, const SurfacePoint& met, const Vec3& way,
                         const PixelSampler& sampler, std::uint32_t dimension) {
  const NextEvent event = sample_emitter(context.world, met, sampler.one(dimension), sampler.two(dimension + 1));
  const float cosine = std::max(0.0F, dot(met.shading_normal, event.direction));
  const Spectrum rho = context.world.surfaces.reflectance(met, -dot(met.shading_normal, way));
  const Spectrum rest = reflector.radiance - reflector.of_direct;
  const Spectrum indirect(std::max(0.0F, rest.r), std::max(0.0F, rest.g), std::max(0.0F, rest.b));  // rounding
  return indirect + rho * event.weight * (cosine * kInversePi);
}

}  // namespace

Spectrum reflected_light(const GatherPoint& point, std::uint32_t rays, std::uint32_t dimension) {
  const GatherContext& context = point.context;
  const float reach = point.near_distance > 0 ? point.near_distance : std::numeric_limits<float>::infinity();
  Spectrum sum;
  const Frame frame(point.surface.shading_normal);
  for (std::uint32_t i = 0; i < rays; ++i) {
    const Vec3 way = normalize(frame.to_world(sample_cosine_hemisphere(point.sampler.two(dimension + i))));
    if (!(dot(way, point.surface.geometric_normal) > 0)) continue;
    ++point.counters.visibility_rays;
    const auto hit = context.world.caster.closest({point.start, way}, point.sampler.key(dimension + i), reach);
    if (!hit) continue;
    SurfacePoint met = context.world.surfaces.at(*hit);
    face(met, -way);
    const Reflector* reflector = reflector_at(context, *hit, met);
    if (reflector == nullptr || reflector->by_lines != 0) continue;
    const Spectrum radiance = context.settings.next_events == 0
                                  ? reflector->radiance
                                  : with_next_event(context, *reflector, met, way, point.sampler, dimension + 2 * rays + 2 * i);
    point.counters.visibility_rays += context.settings.next_events;
    sum += hit->weight * radiance * point.bsdf.diffuse_shape(way);
  }
  return sum * (kPi / static_cast<float>(rays));
}

}  // namespace radfarm
