#include "estimate/off_grid_light.h"

#include <limits>

#include "estimate/lit_reflector.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t kPunctualDimension = 4;
constexpr std::size_t kMaxTracedPunctual = 8;

Spectrum light_of(const GatherPoint& point, const PunctualEmitter& light) {
  const World& world = point.context.world;
  const PunctualArrival arrival = arrive(light, point.surface.position, world.radius);
  const float received = received_from(point, arrival.direction);
  if (received == 0 || !(dot(point.surface.geometric_normal, arrival.direction) > 0) || is_black(arrival.irradiance)) return {};
  ++point.counters.visibility_rays;
  return arrival.irradiance * world.caster.transmittance(point.start, arrival.target) * received;
}

}  // namespace

Arrived light_off_grid(const OffGrid& at, const Vertex& vertex, const Spectrum& next_event, std::uint32_t dimension) {
  const GatherContext& context = at.context;
  Arrived arrived{next_event, {}};
  const Continuation on = go_on_diffuse(vertex, at.sampler.two(dimension + 4));
  if (is_black(on.weight)) return arrived;
  ++at.counters.path_rays;
  Spectrum passed(1.0F);
  const auto hit = context.world.caster.closest(on.ray, at.sampler.key(dimension + 4), kInfinity, &passed);
  if (!hit) {
    arrived.direct += on.weight * passed * weighed_sky(context.world, on.departure);
    return arrived;
  }
  const SurfacePoint met = context.world.surfaces.met(*hit, on.ray);
  arrived.direct += on.weight * hit->weight * weighed_emission(context.world, on.departure, *hit, met);
  const Reflector* reflector = context.has_interreflection ? reflector_at(context, *hit, met) : nullptr;
  if (reflector != nullptr) arrived.indirect += on.weight * hit->weight * reflector->radiance;
  return arrived;
}

Spectrum punctual_light(const GatherPoint& point) {
  const std::vector<PunctualEmitter>& lights = point.context.world.emitters.punctual;
  Spectrum sum;
  if (lights.size() <= kMaxTracedPunctual) {
    for (const PunctualEmitter& light : lights) sum += light_of(point, light);
    return sum;
  }
  std::vector<double> weights;
  for (const PunctualEmitter& light : lights) {
    const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
    weights.push_back(static_cast<double>(luminance(arrival.irradiance) * cosine_to(point, arrival.direction)));
  }
  const DiscreteDistribution choice(weights);
  if (!(choice.total() > 0)) return sum;
  for (std::uint32_t i = 0; i < kMaxTracedPunctual; ++i) {
    const float u = (static_cast<float>(i) + point.sampler.one(kPunctualDimension)) / kMaxTracedPunctual;
    const auto chosen = choice.sample(static_cast<double>(u));
    sum += light_of(point, lights[chosen.index]) * static_cast<float>(1 / (chosen.probability * kMaxTracedPunctual));
  }
  return sum;
}

}  // namespace radfarm
