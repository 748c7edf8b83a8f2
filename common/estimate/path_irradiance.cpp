#include "estimate/path_irradiance.h"

#include <algorithm>

#include "estimate/path_reference.h"
#include "math/sampling.h"
#include "scene/emitter_sampling.h"

namespace radfarm {

Arrived path_irradiance(const World& world, const SurfacePoint& point, const PixelSampler& sampler,
                        const PixelSampler& onward, Counters& counters) {
  const NextEvent event = sample_emitter(world, point, sampler.one(1), sampler.two(2));
  counters.visibility_rays += event.traced ? 1 : 0;
  const Spectrum direct = event.weight * std::max(0.0F, dot(point.shading_normal, event.direction));
  const Vec3 local = sample_cosine_hemisphere(sampler.two(3));
  const Ray ray{leave(point), normalize(Frame(point.shading_normal).to_world(local))};
  if (!(dot(ray.direction, point.geometric_normal) > 0)) return {direct, Spectrum()};
  return {direct, trace_path(world, ray, onward, counters).reflected() * kPi};
}

}  // namespace radfarm
