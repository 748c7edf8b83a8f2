#include "estimate/near_light.h"

#include "math/sampling.h"

namespace radfarm {

Spectrum near_light(const GatherPoint& point, std::uint32_t rays, std::uint32_t dimension) {
  const GatherContext& context = point.context;
  Spectrum sum;
  const Frame frame(point.surface.shading_normal);
  for (std::uint32_t i = 0; i < rays; ++i) {
    const Vec3 way = normalize(frame.to_world(sample_cosine_hemisphere(point.sampler.two(dimension + i))));
    if (!(dot(way, point.surface.geometric_normal) > 0)) continue;
    ++point.counters.visibility_rays;
    const auto hit = context.world.caster.closest({point.start, way}, point.sampler.key(dimension + i), point.near_distance);
    if (!hit) continue;
    SurfacePoint met = context.world.surfaces.at(*hit);
    face(met, -way);
    const std::uint32_t id = context.lookup.find(*hit, met);
    if (id == kNone || context.tree.patches[context.tree.nodes[id].patch].emits != 0) continue;
    const SenderNode& node = context.tree.nodes[id];
    const float share = point.bsdf.diffuse_shape(way) / (node.area * static_cast<float>(rays));
    sum += hit->weight * node.reflected_power * share;
  }
  return sum;
}

}  // namespace radfarm
