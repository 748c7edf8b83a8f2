#include "estimate/path_reference.h"

#include <algorithm>
#include <optional>

#include "math/sampling.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kDimensionsPerBounce = 4;  // emitter choice, emitter point, direction, survival
constexpr std::uint32_t kFirstBounceDimension = 8;  // below: film, lens, coverage of the camera ray
constexpr int kFirstRoulette = 2;
constexpr float kMaxSurvival = 0.99F;

/// The last surface of a path and the way it goes on, for weighing what the next hit emits.
struct Departure {
  Vec3 position;
  Vec3 direction;
  float pdf = 0;  // per steradian
};

/// Light that reaches `point` from one sampled emitter and goes on along the path, times rho / pi and the cosine.
Spectrum next_event(const World& world, const SurfacePoint& point, const Spectrum& rho, const PixelSampler& sampler,
                    std::uint32_t dimension, Counters& counters) {
  const NextEvent event = sample_emitter(world, point, sampler.one(dimension), sampler.two(dimension + 1));
  counters.visibility_rays += event.traced ? 1 : 0;
  const float cosine = dot(point.shading_normal, event.direction);
  if (is_black(event.weight) || !(cosine > 0)) return {};
  return rho * event.weight * (balance_of_event(event, cosine * kInversePi) * cosine * kInversePi);
}

/// The survival probability of a path that carries `throughput` and reflects with rho.
float survival(int bounce, const Spectrum& throughput, const Spectrum& rho) {
  if (bounce < kFirstRoulette) return 1;
  const float before = luminance(throughput);
  return before > 0 ? std::min(kMaxSurvival, luminance(throughput * rho) / before) : 0;
}

}  // namespace

RadianceParts trace_path(const World& world, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters) {
  RadianceParts parts;
  Ray ray = camera_ray;
  Spectrum throughput(1.0F);
  Departure from;
  for (int bounce = 0;; ++bounce) {
    const auto dimension = kFirstBounceDimension + static_cast<std::uint32_t>(bounce) * kDimensionsPerBounce;
    const std::optional<Hit> hit = world.caster.closest(ray, sampler.key(dimension));
    ++(bounce == 0 ? counters.camera_rays : counters.path_rays);
    if (!hit) return parts;
    SurfacePoint point = world.surfaces.at(*hit);
    face(point, -ray.direction);

    // Emission at this vertex: seen by the camera, or as the direct (indirect) light of the vertex before.
    const Spectrum emitted = world.surfaces.emission(point);
    if (bounce == 0) {
      parts.emission = emitted;
    } else if (!is_black(emitted)) {
      const float weight = balance_of_hit(world, *hit, from.position, from.direction, from.pdf);
      (bounce == 1 ? parts.direct : parts.indirect) += throughput * emitted * weight;
    }

    // Next event: emitters seen from this vertex.
    const Spectrum rho = world.surfaces.reflectance(point);
    if (is_black(throughput * rho)) return parts;
    (bounce == 0 ? parts.direct : parts.indirect) +=
        throughput * next_event(world, point, rho, sampler, dimension, counters);

    // Survival, then the next direction by the cosine; weight rho, as pi * pdf = cosine.
    const float survive = survival(bounce, throughput, rho);
    if (survive < 1 && sampler.one(dimension + 3) >= survive) return parts;
    throughput *= rho / survive;
    const Vec3 local = sample_cosine_hemisphere(sampler.two(dimension + 2));
    ray.direction = normalize(Frame(point.shading_normal).to_world(local));
    if (!(dot(ray.direction, point.geometric_normal) > 0)) return parts;
    ray.origin = leave(point);
    from = {point.position, ray.direction, pdf_cosine_hemisphere(local)};
  }
}

}  // namespace radfarm
