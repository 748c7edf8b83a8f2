#include "estimate/path_reference.h"

#include <algorithm>
#include <optional>

#include "estimate/scattering.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kDimensionsPerBounce = 5;   // emitter choice, emitter point, direction, survival, diffuse or specular
constexpr std::uint32_t kFirstBounceDimension = 8;  // below: film, lens, coverage of the camera ray
constexpr int kFirstRoulette = 2;
constexpr float kMaxSurvival = 0.99F;

/// The survival probability of a path whose throughput one more bounce multiplies by `weight`.
float survival(int bounce, const Spectrum& throughput, const Spectrum& weight) {
  if (bounce < kFirstRoulette) return 1;
  const float before = luminance(throughput);
  return before > 0 ? std::min(kMaxSurvival, luminance(throughput * weight) / before) : 0;
}

}  // namespace

RadianceParts trace_path(const World& world, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters,
                         bool has_interreflection) {
  RadianceParts parts;
  Ray ray = camera_ray;
  Spectrum throughput(1.0F);
  Departure from{ray.origin, ray.direction, 0, true};
  PathStage stage = PathStage::kSeen;
  for (int bounce = 0;; ++bounce) {
    const auto dimension = kFirstBounceDimension + static_cast<std::uint32_t>(bounce) * kDimensionsPerBounce;
    Spectrum passed(1.0F);
    const auto hit = world.caster.closest(ray, sampler.key(dimension), std::numeric_limits<float>::infinity(), &passed);
    ++(bounce == 0 ? counters.camera_rays : counters.path_rays);
    if (!hit) {
      part_of_emission(parts, stage) += throughput * passed * weighed_sky(world, from);
      return parts;
    }
    SurfacePoint point = world.surfaces.met(*hit, ray);
    throughput *= hit->weight * world.surfaces.absorption(point, hit->distance);
    part_of_emission(parts, stage) += throughput * weighed_emission(world, from, *hit, point);
    if (stage == PathStage::kReceiver && !has_interreflection) return parts;

    const Bsdf bsdf = bsdf_at(world.surfaces, point, -ray.direction);
    if (is_black(throughput) || !(bsdf.has_diffuse() || bsdf.has_specular())) return parts;
    const Vertex vertex = one_way_vertex(world, point, bsdf);
    const NextEventLight light =
        next_event_light(vertex, sampler.one(dimension), sampler.two(dimension + 1), counters);
    part_of_scattering(parts, stage, false) += throughput * light.diffuse;
    part_of_scattering(parts, stage, true) += throughput * light.specular;

    const Continuation next = go_on(vertex, sampler.one(dimension + 4), sampler.two(dimension + 2));
    const float survive = survival(bounce, throughput, next.weight);
    if (!(survive > 0) || is_black(next.weight)) return parts;
    if (survive < 1 && sampler.one(dimension + 3) >= survive) return parts;
    throughput *= next.weight / survive;
    stage = stage_after(stage, next.is_specular);
    ray = next.ray;
    from = next.departure;
  }
}

}  // namespace radfarm
