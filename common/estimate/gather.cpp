#include "estimate/gather.h"

#include <algorithm>

#include "estimate/near_light.h"
#include "estimate/sender_light.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kCoverageDimension = 1;
constexpr std::uint32_t kVertexDimension = 2;
constexpr std::uint32_t kChoiceDimension = 3;
constexpr std::uint32_t kPunctualDimension = 4;
constexpr std::uint32_t kNearDimension = 8;  // and the next ones
constexpr std::uint32_t kFirstSenderDimension = 64;

// Of the samples of a gather, besides them, as many go to what is near.
constexpr float kNearShare = 0.25F;
// More punctual lights than this are sampled by their unoccluded irradiance at the point instead of all traced.
constexpr std::size_t kMaxTracedPunctual = 8;

void add_lobes(const GatherPoint& point, const VertexSenders& senders, Arrived& arrived) {
  for (const Lobe& lobe : senders.lobes) {
    const float cosine = cosine_to(point, lobe.direction);
    arrived.direct += lobe.direct * cosine;
    arrived.indirect += lobe.indirect * cosine;
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
  if (!(total > 0)) return;
  const float step = total / point.context.settings.samples_per_gather;
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

void add_punctual_light(const GatherPoint& point, const PunctualLight& light, float weight, Arrived& arrived) {
  const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
  const float cosine = cosine_to(point, arrival.direction);
  if (cosine == 0 || !(dot(point.surface.geometric_normal, arrival.direction) > 0)) return;
  if (is_black(arrival.irradiance)) return;
  ++point.counters.visibility_rays;
  const float visible = point.context.world.caster.transmittance(point.start, arrival.target);
  arrived.direct += arrival.irradiance * (cosine * visible * weight);
}

void add_punctual(const GatherPoint& point, Arrived& arrived) {
  const std::vector<PunctualLight>& lights = point.context.world.emitters.punctual;
  if (lights.size() <= kMaxTracedPunctual) {
    for (const PunctualLight& light : lights) add_punctual_light(point, light, 1, arrived);
    return;
  }
  std::vector<double> weights;
  for (const PunctualLight& light : lights) {
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

}  // namespace

RadianceParts gather_radiance(const GatherContext& context, const Ray& ray, const PixelSampler& sampler,
                              Counters& counters) {
  RadianceParts parts;
  ++counters.camera_rays;
  const auto hit = context.world.caster.closest(ray, sampler.key(kCoverageDimension));
  if (!hit) return parts;
  SurfacePoint surface = context.world.surfaces.at(*hit);
  face(surface, -ray.direction);
  parts.emission = context.world.surfaces.emission(surface);
  const Spectrum rho = context.world.surfaces.reflectance(surface);
  if (is_black(rho)) return parts;

  const GatherPoint point{context, surface, sampler, counters, leave(surface),
                    context.senders.grid().cell_width(surface.position)};
  Arrived arrived;
  add_punctual(point, arrived);
  if (!context.tree.nodes.empty()) {
    const Interpolation at = interpolate(context.senders.grid(), surface.position);
    const VertexSenders& senders = context.senders.at(choose_vertex(at, sampler.one(kVertexDimension)));
    add_lobes(point, senders, arrived);
    add_critical(point, senders, arrived);
    const auto rays = std::max(1U, static_cast<std::uint32_t>(kNearShare * context.settings.samples_per_gather));
    if (context.has_interreflection) arrived.indirect += near_light(point, rays, kNearDimension);
  }
  parts.direct = rho * arrived.direct * kInversePi;
  if (context.has_interreflection) parts.indirect = rho * arrived.indirect * kInversePi;
  return parts;
}

}  // namespace radfarm
