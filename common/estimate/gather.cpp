#include "estimate/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimate/eye_chain.h"
#include "estimate/near_light.h"
#include "estimate/sender_light.h"
#include "estimate/sky_light.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t kVertexDimension = 2;
constexpr std::uint32_t kChoiceDimension = 3;
constexpr std::uint32_t kPunctualDimension = 4;
constexpr std::uint32_t kNearDimension = 8;  // and the next ones
constexpr std::uint32_t kFirstSenderDimension = 64;
constexpr std::uint32_t kFirstSkyDimension = 1U << 16;

// Of the samples of a gather, besides them, as many go to the sky.
constexpr float kSkyShare = 0.5F;

// Of the samples of a gather, besides them, as many go to what is near.
constexpr float kNearShare = 0.25F;
// More punctual lights than this are sampled by their unoccluded irradiance at the point instead of all traced.
constexpr std::size_t kMaxTracedPunctual = 8;

void add_lobes(const GatherPoint& point, const VertexSenders& senders, Arrived& arrived) {
  for (const Lobe& lobe : senders.lobes) {
    const float received = received_from(point, lobe.direction);
    arrived.direct += lobe.direct * received;
    arrived.indirect += lobe.indirect * received;
  }
}

/// What a critical sender is likely to give the point, luminance: known but for visibility where its form factor is interpolated.
float likely_from(const GatherPoint& point, const CriticalSender& sender) {
  if (sender.resample_form_factor == 0) {
    return sender.prior * luminance(sender.direct + sender.indirect) * cosine_to(point, sender.direction);
  }
  return sender.prior * judge_irradiance(sender.outline, point.surface.position, point.surface.shading_normal,
                                         point.near_distance).likely;
}

/// (gather.2) Draws senders by systematic sampling in proportion to what each is likely to give this very point: N positions,
/// one step apart from a random start, fall on senders laid end to end by their weights; sender s is taken floor or ceil of
/// N w_s times, N w_s on average.
void add_critical(const GatherPoint& point, const VertexSenders& senders, Arrived& arrived) {
  thread_local std::vector<float> likely;  // scratch: one a sender
  likely.clear();
  float total = 0;
  for (const CriticalSender& sender : senders.critical) total += likely.emplace_back(likely_from(point, sender));
  const float step = total / point.context.settings.samples_per_gather;
  if (!(step > 0)) return;  // nothing, or so little that a line's share is no float
  std::uint32_t dimension = kFirstSenderDimension;
  float position = point.sampler.one(kChoiceDimension) * step, until = 0;
  for (std::size_t i = 0; i < likely.size(); ++i) {
    until += likely[i];
    std::uint32_t count = 0;
    for (; position < until; position += step) ++count;
    if (count == 0) continue;
    const Arrived one = light_of_sender(point, senders.critical[i], count, dimension);
    const float weight = static_cast<float>(count) * step / likely[i];
    arrived.direct += one.direct * weight;
    arrived.indirect += one.indirect * weight;
    dimension += 4 * count;
  }
}

void add_punctual_light(const GatherPoint& point, const PunctualEmitter& light, float weight, Arrived& arrived) {
  const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
  const float received = received_from(point, arrival.direction);
  if (received == 0 || !(dot(point.surface.geometric_normal, arrival.direction) > 0)) return;
  if (is_black(arrival.irradiance)) return;
  ++point.counters.visibility_rays;
  const Spectrum visible = point.context.world.caster.transmittance(point.start, arrival.target);
  arrived.direct += arrival.irradiance * visible * (received * weight);
}

void add_punctual(const GatherPoint& point, Arrived& arrived) {
  const std::vector<PunctualEmitter>& lights = point.context.world.emitters.punctual;
  if (lights.size() <= kMaxTracedPunctual) {
    for (const PunctualEmitter& light : lights) add_punctual_light(point, light, 1, arrived);
    return;
  }
  std::vector<double> weights;
  for (const PunctualEmitter& light : lights) {
    const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
    weights.push_back(static_cast<double>(luminance(arrival.irradiance) * cosine_to(point, arrival.direction)));
  }
  const DiscreteDistribution choice(weights);
  if (!(choice.total() > 0)) return;
  for (std::uint32_t i = 0; i < kMaxTracedPunctual; ++i) {
    const float u = (static_cast<float>(i) + point.sampler.one(kPunctualDimension)) / kMaxTracedPunctual;
    const auto chosen = choice.sample(static_cast<double>(u));
    const auto weight = static_cast<float>(1 / (chosen.probability * kMaxTracedPunctual));
    add_punctual_light(point, lights[chosen.index], weight, arrived);
  }
}

/// The light of the grid at a point that the camera sees.
Arrived gather_on_grid(const GatherPoint& point) {
  const GatherContext& context = point.context;
  Arrived arrived;
  add_punctual(point, arrived);
  const bool has_sky = !context.world.environment.is_empty();
  if (context.tree.nodes.empty() && !has_sky) return arrived;
  const Interpolation at = interpolate(context.senders.grid(), point.surface.position);
  const VertexSenders& senders = context.senders.at(choose_vertex(at, point.sampler.one(kVertexDimension)));
  const auto share_of_samples = [&](float share) {
    return std::max(1U, static_cast<std::uint32_t>(share * static_cast<float>(context.settings.samples_per_gather)));
  };
  if (has_sky) arrived.direct += sky_light(point, senders.sky, share_of_samples(kSkyShare), kFirstSkyDimension);
  if (context.tree.nodes.empty()) return arrived;
  add_lobes(point, senders, arrived);
  add_critical(point, senders, arrived);
  if (context.has_interreflection) arrived.indirect += near_light(point, share_of_samples(kNearShare), kNearDimension);
  return arrived;
}

/// What the radiosity solution says a diffuse surface reflects where a ray meets it, cd/m^2.
Spectrum reflected_radiance(const GatherContext& context, const Hit& hit, const SurfacePoint& met) {
  const std::uint32_t id = context.lookup.find(hit, met);
  if (id == kNone) return {};
  const SenderNode& node = context.tree.nodes[id];
  return hit.weight * node.reflected_power * (kInversePi / node.area);
}

/// The diffuse part of a vertex beyond the first, where no grid is: a next event, and one ray that finds an emitter, the sky or
/// what the radiosity solution has there. Radiance, by class.
Arrived gather_off_grid(const GatherContext& context, const Vertex& vertex, const Spectrum& next_event,
                        const PixelSampler& sampler, std::uint32_t dimension, Counters& counters) {
  Arrived arrived{next_event, {}};
  const Continuation on = go_on_diffuse(vertex, sampler.two(dimension + 4));
  if (is_black(on.weight)) return arrived;
  ++counters.path_rays;
  Spectrum passed(1.0F);
  const auto hit = context.world.caster.closest(on.ray, sampler.key(dimension + 4), kInfinity, &passed);
  if (!hit) {
    arrived.direct += on.weight * passed * weighed_sky(context.world, on.departure);
    return arrived;
  }
  const SurfacePoint met = context.world.surfaces.met(*hit, on.ray);
  arrived.direct += on.weight * hit->weight * weighed_emission(context.world, on.departure, *hit, met);
  if (context.has_interreflection) arrived.indirect += on.weight * reflected_radiance(context, *hit, met);
  return arrived;
}

/// Grid final gather where the camera looks, and what gather_off_grid() finds beyond.
class GridLight : public DiffuseLight {
 public:
  explicit GridLight(const GatherContext& context) : context_(context) {}

  Arrived seen(const SeenPoint& at, const PixelSampler& sampler, Counters& counters) const override {
    return gather_on_grid({context_, at.point, at.bsdf, sampler, counters, leave(at.point),
                           context_.senders.grid().cell_width(at.point.position)});
  }
  Arrived beyond(const Hit&, const Vertex& vertex, const Spectrum& next_event, const PixelSampler& sampler,
                 std::uint32_t dimension, Counters& counters) const override {
    return gather_off_grid(context_, vertex, next_event, sampler, dimension, counters);
  }

 private:
  const GatherContext& context_;
};

}  // namespace

RadianceParts gather_radiance(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                              Counters& counters) {
  const GridLight light(context);
  return trace_eye_chain({context.world, light, context.has_interreflection}, camera_ray, sampler, counters);
}

}  // namespace radfarm
