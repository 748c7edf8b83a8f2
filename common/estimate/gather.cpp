#include "estimate/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "estimate/near_light.h"
#include "estimate/scattering.h"
#include "estimate/sender_light.h"
#include "estimate/sky_light.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t kCoverageDimension = 1;
constexpr std::uint32_t kVertexDimension = 2;
constexpr std::uint32_t kChoiceDimension = 3;
constexpr std::uint32_t kPunctualDimension = 4;
constexpr std::uint32_t kNearDimension = 8;  // and the next ones
constexpr std::uint32_t kFirstSenderDimension = 64;
constexpr std::uint32_t kFirstSkyDimension = 1U << 16;
constexpr std::uint32_t kFirstChainDimension = 1U << 17;  // of the eye chain's bounces ...
constexpr std::uint32_t kDimensionsPerBounce = 8;         // ... each ...
constexpr std::uint32_t kDimensionsPerChain = 1U << 12;   // ... and of each chain
constexpr std::uint32_t kMaxPanes = 64;                   // that a camera ray goes through
constexpr std::uint32_t kChains = 4;                      // of a sample that meets gloss

// Of the samples of a gather, besides them, as many go to the sky.
constexpr float kSkyShare = 0.5F;
// An eye chain goes on with this many times the luminance that it carries: what carries little is rarely followed.
constexpr float kFollowed = 64;
constexpr float kMaxSurvival = 0.99F;

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

/// What the camera sees by specular surfaces: vertices whose specular part goes on, each with its diffuse part gathered.
class EyeChain {
 public:
  EyeChain(const GatherContext& context, const PixelSampler& sampler, Counters& counters)
      : context_(context), sampler_(sampler), counters_(counters) {}

  /// Both what passes panes and what they reflect is followed: left to chance, one sample in ten would see the reflection.
  RadianceParts trace(Ray ray) {
    ++counters_.camera_rays;
    const Surfaces& surfaces = context_.world.surfaces;
    Spectrum throughput(1.0F);
    for (std::uint32_t panes = 0; panes < kMaxPanes && !is_black(throughput); ++panes) {
      const auto hit = context_.world.caster.closest_with_panes(ray, sampler_.key(kCoverageDimension));
      const auto met = arrive_at(ray, {ray.origin, ray.direction, 0, true}, hit, throughput, PathStage::kSeen);
      if (!met) return parts_;
      SurfacePoint point = met->point;
      const bool is_pane = surfaces.is_pane(surfaces.scene().instances[hit->instance].mesh);
      // About as many chains as the diffuse part has rays: else gloss, or what a mirror shows, would be the image's noise.
      scatter_seen(point, -ray.direction, met->throughput, panes, is_pane ? 1 : kChains);
      if (!is_pane) return parts_;
      const float cosine = std::fabs(dot(point.geometric_normal, ray.direction));
      throughput = met->throughput * pane_passage(surfaces.matter(point), cosine);
      ray = {leave(point, ray.direction), ray.direction, point.cone};
    }
    return parts_;
  }

 private:
  struct Met {
    SurfacePoint point;
    Spectrum throughput;
  };

  Spectrum& emission(PathStage stage) { return part_of_emission(parts_, stage); }

  /// Where a ray ended; adds what is emitted there, or by the sky.
  std::optional<Met> arrive_at(const Ray& ray, const Departure& from, const std::optional<Hit>& hit, const Spectrum& throughput,
                               PathStage stage) {
    const World& world = context_.world;
    if (!hit) {
      emission(stage) += throughput * weighed_sky(world, from);
      return std::nullopt;
    }
    Met met{world.surfaces.met(*hit, ray), throughput};
    met.throughput *= hit->weight * world.surfaces.absorption(met.point, hit->distance);
    emission(stage) += met.throughput * weighed_emission(world, from, *hit, met.point);
    return met;
  }

  /// What the camera sees first, or by panes.
  void scatter_seen(SurfacePoint& point, const Vec3& to_viewer, const Spectrum& throughput, std::uint32_t panes,
                    std::uint32_t chains) {
    const Bsdf bsdf = bsdf_at(context_.world.surfaces, point, to_viewer);
    gather_here(point, bsdf, throughput);
    if (!bsdf.has_specular()) return;
    const Vertex vertex{context_.world, point, bsdf, 1, 1};
    for (std::uint32_t k = 0; k < chains; ++k) {
      follow(vertex, throughput / static_cast<float>(chains),
             kFirstChainDimension + (panes * kChains + k) * kDimensionsPerChain);
    }
  }

  /// The diffuse part of what the camera sees first.
  void gather_here(const SurfacePoint& point, const Bsdf& bsdf, const Spectrum& throughput) {
    if (!bsdf.has_diffuse()) return;
    const Arrived irradiance = gather_on_grid({context_, point, bsdf, sampler_, counters_, leave(point),
                                               context_.senders.grid().cell_width(point.position)});
    const Spectrum reflected = throughput * bsdf.diffuse_reflectance() * kInversePi;
    parts_.direct += reflected * irradiance.direct;
    if (context_.has_interreflection) parts_.indirect += reflected * irradiance.indirect;
  }

  /// One chain from a vertex on: its highlights, then the vertices behind.
  void follow(const Vertex& first, Spectrum throughput, std::uint32_t dimension) {
    const NextEventLight highlight =
        next_event_light(first, sampler_.one(dimension), sampler_.two(dimension + 1), counters_);
    parts_.specular += throughput * highlight.specular;
    Continuation next = go_on_specular(first, sampler_.one(dimension + 2), sampler_.two(dimension + 3));
    while (survives(next, throughput, dimension)) {
      dimension += kDimensionsPerBounce;
      ++counters_.path_rays;
      Spectrum passed(1.0F);
      const auto hit = context_.world.caster.closest(next.ray, sampler_.key(dimension), kInfinity, &passed);
      const auto met = arrive_at(next.ray, next.departure, hit, throughput * passed, PathStage::kEyeChain);
      if (!met) return;
      throughput = met->throughput;
      SurfacePoint point = met->point;
      const Bsdf bsdf = bsdf_at(context_.world.surfaces, point, -next.ray.direction);
      const Vertex vertex{context_.world, point, bsdf, 1, 1};
      scatter_off_grid(vertex, throughput, dimension);
      if (!bsdf.has_specular()) return;
      next = go_on_specular(vertex, sampler_.one(dimension + 2), sampler_.two(dimension + 3));
    }
  }

  /// Both parts of a vertex beyond the first.
  void scatter_off_grid(const Vertex& vertex, const Spectrum& throughput, std::uint32_t dimension) {
    const NextEventLight event =
        next_event_light(vertex, sampler_.one(dimension), sampler_.two(dimension + 1), counters_);
    parts_.specular += throughput * event.specular;
    if (!vertex.bsdf.has_diffuse()) return;
    const Arrived radiance = gather_off_grid(context_, vertex, event.diffuse, sampler_, dimension, counters_);
    parts_.direct += throughput * radiance.direct;
    parts_.indirect += throughput * radiance.indirect;
  }

  /// Ends chains that carry little, by chance.
  bool survives(const Continuation& next, Spectrum& throughput, std::uint32_t dimension) {
    const float survive = std::min(kMaxSurvival, kFollowed * luminance(throughput * next.weight));
    if (!(survive > 0) || sampler_.one(dimension + 5) >= survive) return false;
    throughput *= next.weight / survive;
    return true;
  }

  const GatherContext& context_;
  const PixelSampler& sampler_;
  Counters& counters_;
  RadianceParts parts_;
};

}  // namespace

RadianceParts gather_radiance(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                              Counters& counters) {
  return EyeChain(context, sampler, counters).trace(camera_ray);
}

}  // namespace radfarm
