#include "radiosity/direct.h"

#include <algorithm>
#include <limits>

#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kDirectKey = 0x646972;  // "dir"
constexpr std::uint32_t kMaxSamples = 256;
constexpr float kSamplesPerScene = 4e5F;  // spread over the area, besides the least of each patch

/// Irradiance from a sampled emitter.
Spectrum by_next_event(const World& world, const SurfacePoint& point, float choice, const Vec2& u) {
  const NextEvent event = sample_emitter(world, point, choice, u);
  const float cosine = std::max(0.0F, dot(point.shading_normal, event.direction));
  return event.weight * (balance_of_event(event, cosine * kInversePi) * cosine);
}

/// Irradiance from the emitter or the sky that a cosine-distributed ray meets: what lies so close that next events hardly choose it.
Spectrum by_ray(const World& world, const SurfacePoint& point, const Vec2& u, std::uint64_t key) {
  const Vec3 local = sample_cosine_hemisphere(u);
  const Ray ray{leave(point), normalize(Frame(point.shading_normal).to_world(local))};
  if (!(dot(ray.direction, point.geometric_normal) > 0)) return {};
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Spectrum passed(1.0F);
  const float pdf = pdf_cosine_hemisphere(local);
  const auto hit = world.caster.closest(ray, key, kInfinity, &passed);
  if (!hit && world.environment.is_empty()) return {};
  if (!hit) {
    return world.environment.radiance(ray.direction) * passed * (balance_of_sky(world, ray.direction, pdf) * kPi);
  }
  if (world.emitters.find(hit->instance, hit->triangle) == kNone) return {};
  SurfacePoint target = world.surfaces.at(*hit);
  face(target, -ray.direction);
  const float weight = balance_of_hit(world, *hit, point.position, ray.direction, pdf);
  return world.emission(target) * hit->weight * (weight * kPi);
}

Spectrum estimate_at(const World& world, const SurfacePoint& point, std::uint32_t i, std::uint64_t key) {
  return by_next_event(world, point, sobol_owen_1d(i, combine(key, 2)), sobol_owen_2d(i, combine(key, 3))) +
         by_ray(world, point, sobol_owen_2d(i, combine(key, 4)), combine(key, 5, i));
}

Spectrum sample_patch(const World& world, const Patch& patch, std::uint32_t samples, std::uint64_t key) {
  SpectrumD sum;
  for (std::uint32_t i = 0; i < samples; ++i) {
    sum += SpectrumD(estimate_at(world, point_on_patch(world, patch, sobol_owen_2d(i, combine(key, 1))), i, key));
  }
  return Spectrum(sum / static_cast<double>(samples));
}

}  // namespace

std::array<float, 2> estimate_twice(const World& world, const Patch& patch, std::uint32_t index, std::uint64_t key) {
  const SurfacePoint point = point_on_patch(world, patch, sobol_owen_2d(index, combine(key, 1)));
  return {luminance(estimate_at(world, point, index, combine(key, 6))),
          luminance(estimate_at(world, point, index, combine(key, 7)))};
}

SurfacePoint point_on_patch(const World& world, const Patch& patch, const Vec2& u) {
  const Vec3 b = sample_uniform_triangle(u);
  const Vec3 position = patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z;
  SurfacePoint point = world.surfaces.at(world.surfaces.hit_at(patch.instance, patch.triangle, position));
  face(point, patch.normal);
  return point;
}

void sample_direct(const World& world, const Hierarchy& hierarchy, std::uint32_t min_samples, std::uint64_t seed,
                   std::vector<Spectrum>& direct, const Progress& progress) {
  direct.resize(hierarchy.nodes.size(), kNotSampled);
  const float per_area = kSamplesPerScene / hierarchy.nodes[0].area;
  parallel_for(progress, "radiosity: direct light", hierarchy.nodes.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Node& node = hierarchy.nodes[i];
      if (node.is_cluster() || node.child_count > 0 || direct[i] != kNotSampled) continue;
      const auto samples = std::clamp(static_cast<std::uint32_t>(node.area * per_area), min_samples, std::max(min_samples, kMaxSamples));
      direct[i] = sample_patch(world, hierarchy.patches[node.patch], samples, combine(seed, kDirectKey, i));
    }
  });
}

}  // namespace radfarm
