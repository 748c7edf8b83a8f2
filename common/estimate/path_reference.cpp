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

/// What of a path's light the first surface's diffuse part reflects: the irradiance there.                (path.4)
struct FirstReflection {
  FirstSurface* surface = nullptr;   // none: nobody asks
  Spectrum throughput;               // of the way from the camera
  NextEventLight next_event;
  bool goes_on_specular = false;

  void end(const RadianceParts& parts) const {
    if (surface == nullptr || !surface->is_seen) return;
    const Spectrum diffuse = goes_on_specular ? throughput * next_event.diffuse
                                              : parts.reflected() - throughput * next_event.specular;
    const auto irradiance = [](float reflected, float scale) {
      return scale > 0 ? std::max(0.0F, kPi * reflected / scale) : 0.0F;
    };
    const Spectrum scale = throughput * surface->albedo;
    surface->irradiance = {irradiance(diffuse.r, scale.r), irradiance(diffuse.g, scale.g), irradiance(diffuse.b, scale.b)};
  }
};

void follow_path(const World& world, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters,
                 bool has_interreflection, RadianceParts& parts, FirstReflection& first) {
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
      return;
    }
    SurfacePoint point = world.surfaces.met(*hit, ray);
    throughput *= hit->weight * world.surfaces.absorption(point, hit->distance);
    part_of_emission(parts, stage) += throughput * weighed_emission(world, from, *hit, point);
    if (stage == PathStage::kReceiver && !has_interreflection) return;

    const Bsdf bsdf = bsdf_at(world.surfaces, point, -ray.direction);
    const bool is_first = bounce == 0 && first.surface != nullptr;
    if (is_first) {
      *first.surface = first_surface(point, bsdf, {});
      first.throughput = throughput;
    }
    if (is_black(throughput) || !(bsdf.has_diffuse() || bsdf.has_specular())) return;
    const Vertex vertex = one_way_vertex(world, point, bsdf);
    const NextEventLight light =
        next_event_light(vertex, sampler.one(dimension), sampler.two(dimension + 1), counters);
    part_of_scattering(parts, stage, false) += throughput * light.diffuse;
    part_of_scattering(parts, stage, true) += throughput * light.specular;

    const Continuation next = go_on(vertex, sampler.one(dimension + 4), sampler.two(dimension + 2));
    const float survive = survival(bounce, throughput, next.weight);
    if (is_first) {
      first.next_event = light;
      first.goes_on_specular = next.is_specular;
    }
    if (!(survive > 0) || is_black(next.weight)) return;
    if (survive < 1 && sampler.one(dimension + 3) >= survive) return;
    throughput *= next.weight / survive;
    stage = stage_after(stage, next.is_specular);
    ray = next.ray;
    from = next.departure;
  }
}

}  // namespace

RadianceParts trace_path(const World& world, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters,
                         bool has_interreflection, FirstSurface* first) {
  RadianceParts parts;
  FirstReflection reflection{first, {}, {}, false};
  follow_path(world, camera_ray, sampler, counters, has_interreflection, parts, reflection);
  reflection.end(parts);
  return parts;
}

}  // namespace radfarm
