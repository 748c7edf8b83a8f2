#include "estimate/eye_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace radfarm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t kFirstChainDimension = 1U << 17;  // of the eye chain's bounces ...
constexpr std::uint32_t kDimensionsPerBounce = 8;         // ... each ...
constexpr std::uint32_t kDimensionsPerChain = 1U << 12;   // ... and of each chain
constexpr std::uint32_t kMaxPanes = 64;                   // that a camera ray goes through
constexpr std::uint32_t kChains = 4;                      // of a sample that meets gloss

// An eye chain goes on with this many times the luminance that it carries: what carries little is rarely followed.
constexpr float kFollowed = 64;
constexpr float kMaxSurvival = 0.99F;

/// What the camera sees by specular surfaces: vertices whose specular part goes on, each with its diffuse part gathered.
class EyeChain {
 public:
  EyeChain(const EyeChainContext& context, const PixelSampler& sampler, Counters& counters)
      : context_(context), sampler_(sampler), counters_(counters) {}

  /// Both what passes panes and what they reflect is followed: left to chance, one sample in ten would see the reflection.
  RadianceParts trace(Ray ray, bool scatters = true) {
    ++counters_.camera_rays;
    const Surfaces& surfaces = context_.world.surfaces;
    Spectrum throughput(1.0F);
    for (std::uint32_t panes = 0; panes < kMaxPanes && !is_black(throughput); ++panes) {
      const auto hit = context_.world.caster.closest_with_panes(ray, sampler_.key(kCoverageDimension));
      const auto met = arrive_at(ray, {ray.origin, ray.direction, 0, true}, hit, throughput, PathStage::kSeen);
      if (!met) return parts_;
      SurfacePoint point = met->point;
      const bool is_pane = surfaces.is_pane(surfaces.scene().instances[hit->instance].mesh);
      if (scatters) scatter_seen(*hit, point, -ray.direction, met->throughput, panes, is_pane);
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
  void scatter_seen(const Hit& hit, SurfacePoint& point, const Vec3& to_viewer, const Spectrum& throughput,
                    std::uint32_t panes, bool is_pane) {
    const Bsdf bsdf = bsdf_at(context_.world.surfaces, point, to_viewer);
    const Spectrum irradiance = gather_here({hit, point, bsdf}, throughput);
    if (context_.first != nullptr && !is_pane) *context_.first = first_surface(point, bsdf, irradiance);
    if (!bsdf.has_specular()) return;
    // About as many chains as the diffuse part has rays: else gloss, or what a mirror shows, would be the image's noise.
    const std::uint32_t chains = is_pane ? 1 : kChains;
    const Vertex vertex{context_.world, point, bsdf, 1, 1};
    for (std::uint32_t k = 0; k < chains; ++k) {
      follow(vertex, throughput / static_cast<float>(chains),
             kFirstChainDimension + (panes * kChains + k) * kDimensionsPerChain);
    }
  }

  /// The diffuse part of what the camera sees first; returns its irradiance, lux.
  Spectrum gather_here(const SeenPoint& at, const Spectrum& throughput) {
    if (!at.bsdf.has_diffuse()) return {};
    const Arrived irradiance = context_.light.seen(at, sampler_, counters_);
    const Spectrum reflected = throughput * at.bsdf.diffuse_reflectance() * kInversePi;
    if (context_.receivers != nullptr) (*context_.receivers)(at.hit, at.point, reflected);
    parts_.direct += reflected * irradiance.direct;
    if (!context_.has_interreflection) return irradiance.direct;
    parts_.indirect += reflected * irradiance.indirect;
    return irradiance.direct + irradiance.indirect;
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
      scatter_beyond(*hit, vertex, throughput, dimension);
      if (!bsdf.has_specular()) return;
      next = go_on_specular(vertex, sampler_.one(dimension + 2), sampler_.two(dimension + 3));
    }
  }

  /// Both parts of a vertex beyond the first.
  void scatter_beyond(const Hit& hit, const Vertex& vertex, const Spectrum& throughput, std::uint32_t dimension) {
    const NextEventLight event =
        next_event_light(vertex, sampler_.one(dimension), sampler_.two(dimension + 1), counters_);
    parts_.specular += throughput * event.specular;
    if (!vertex.bsdf.has_diffuse()) return;
    if (context_.receivers != nullptr) {
      (*context_.receivers)(hit, vertex.point, throughput * vertex.bsdf.diffuse_reflectance() * kInversePi);
    }
    const Arrived radiance = context_.light.beyond(hit, vertex, event.diffuse, sampler_, dimension, counters_);
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

  const EyeChainContext& context_;
  const PixelSampler& sampler_;
  Counters& counters_;
  RadianceParts parts_;
};

}  // namespace

RadianceParts trace_eye_chain(const EyeChainContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                              Counters& counters) {
  return EyeChain(context, sampler, counters).trace(camera_ray);
}

Spectrum seen_emission(const EyeChainContext& context, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters) {
  return EyeChain(context, sampler, counters).trace(camera_ray, false).emission;
}

}  // namespace radfarm
