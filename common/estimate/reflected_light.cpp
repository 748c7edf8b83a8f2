#include "estimate/reflected_light.h"

#include <limits>

#include "estimate/lit_reflector.h"
#include "math/sampling.h"

namespace radfarm {

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
    const Spectrum radiance = radiance_at(point, *reflector, met, way, dimension + 2 * rays + 2 * i);
    sum += hit->weight * radiance * point.bsdf.diffuse_shape(way);
  }
  return sum * (kPi / static_cast<float>(rays));
}

}  // namespace radfarm
