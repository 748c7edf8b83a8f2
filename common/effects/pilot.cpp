#include "effects/pilot.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "scene/emission_sampling.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kRays = 4096;
constexpr int kBounces = 8;
constexpr std::uint64_t kPilotKey = 0x70696c6f74;  // "pilot"

/// Upper end of a one-sided 95 % interval of a probability, k successes in n: the rule of three for none. [Wilson 1927]
double upper_end(std::uint32_t k, std::uint32_t n) {
  if (n == 0) return 1;
  if (k == 0) return std::min(1.0, 3.0 / n);
  constexpr double kZ = 1.645;
  const double p = static_cast<double>(k) / n, z = kZ * kZ / n;
  return std::min(1.0, (p + z / 2 + kZ * std::sqrt(p * (1 - p) / n + z / (4 * n))) / (1 + z));
}

/// Diameter of the circle of confusion, in pixels, of a point at `depth` along the view. [ALGORITHMS X23]
float blur_of(const Camera& camera, int height, float depth) {
  if (!(camera.lens_diameter > 0) || !(depth > 0)) return 0;
  const float focal_pixels = static_cast<float>(height) / (2 * std::tan(camera.vertical_fov / 2));
  return camera.lens_diameter * focal_pixels * std::fabs(depth - camera.focus_distance) / (depth * camera.focus_distance);
}

double direct_radiance(const World& world, const SurfacePoint& point, const Bsdf& bsdf, RandomSequence& random) {
  const NextEvent event = sample_emitter(world, point, random.uniform(), {random.uniform(), random.uniform()});
  const float cosine = std::max(0.0F, dot(point.shading_normal, event.direction));
  return static_cast<double>(luminance(bsdf.eval_diffuse(event.direction) * event.weight * cosine));
}

/// One bounce, by the part that scatters more or less: a sample of where light goes, not a weighed one.
Ray bounce(const SurfacePoint& point, const Bsdf& bsdf, bool& is_diffuse, RandomSequence& random) {
  const float specular = bsdf.has_specular() ? luminance(bsdf.specular_albedo()) : 0;
  const float diffuse = luminance(bsdf.diffuse_reflectance());
  is_diffuse = !(random.uniform() * (specular + diffuse) < specular);
  const Vec2 u{random.uniform(), random.uniform()};
  if (!is_diffuse) {
    const Bsdf::Sample sample = bsdf.sample_specular(random.uniform(), u);
    if (!is_black(sample.weight)) return {leave(point, sample.direction), sample.direction};
    is_diffuse = true;
  }
  const Vec3 way = normalize(Frame(point.geometric_normal).to_world(sample_cosine_hemisphere(u)));
  return {leave(point), way};
}

/// Follows a walk on from `ray`; true when it meets nothing.
bool walk(const World& world, Ray ray, bool is_first, Pilot& pilot, RandomSequence& random) {
  bool was_diffuse = false;
  for (int depth = 0; depth < kBounces; ++depth) {
    if (was_diffuse) ++pilot.bounces;
    const auto hit = world.caster.closest(ray, random.bits());
    if (!hit) return true;
    SurfacePoint point = world.surfaces.at(*hit);
    face(point, -ray.direction);
    const Bsdf bsdf = bsdf_at(world.surfaces, point, -ray.direction);
    if (was_diffuse && (bsdf.has_diffuse() || bsdf.has_specular())) {
      ++pilot.met;
      pilot.met_radiance += direct_radiance(world, point, bsdf, random);
    }
    if (depth == 0 && is_first) {
      ++pilot.hits;
      pilot.direct_radiance += direct_radiance(world, point, bsdf, random);
      if (bsdf.has_specular()) pilot.specular_share += static_cast<double>(luminance(bsdf.specular_albedo()));
    }
    if (!bsdf.has_diffuse() && !bsdf.has_specular()) return false;  // absorbed
    ray = bounce(point, bsdf, was_diffuse, random);
  }
  return false;
}

float depth_of(const World& world, const Camera& camera, const Ray& ray, std::uint64_t key) {
  const auto hit = world.caster.closest(ray, key);
  return hit ? hit->distance * dot(ray.direction, camera.forward) : 0;
}

}  // namespace

double Pilot::meets_at_most() const { return upper_end(met, bounces); }
double Pilot::escapes_at_most() const { return upper_end(escaped, walks); }

Pilot run_pilot(const World& world, const Camera& camera, int width, int height, std::uint64_t seed) {
  Pilot pilot;
  if (world.emitters.size() == 0) return pilot;
  for (; pilot.rays < kRays; ++pilot.rays) {
    RandomSequence random(combine(seed, kPilotKey, pilot.rays));
    const Vec2 film = sobol_owen_2d(pilot.rays, combine(seed, kPilotKey));
    const Ray ray = camera_ray(camera, width, height, film.x * static_cast<float>(width), film.y * static_cast<float>(height));
    if (camera.lens_diameter > 0) {
      pilot.max_blur = std::max(pilot.max_blur, blur_of(camera, height, depth_of(world, camera, ray, random.bits())));
    }
    const std::uint32_t hits = pilot.hits;
    const bool has_escaped = walk(world, ray, true, pilot, random);
    if (pilot.hits > hits) {
      ++pilot.walks;
      pilot.escaped += has_escaped ? 1 : 0;
      continue;
    }
    // The camera looks past the scene: a walk from an emitter says whether light can leave.
    const Vec2 place{random.uniform(), random.uniform()}, way{random.uniform(), random.uniform()};
    ++pilot.walks;
    pilot.escaped += walk(world, sample_emission(world, random.uniform_double(), place, way).ray, false, pilot, random) ? 1 : 0;
  }
  pilot.direct_radiance /= kRays;
  pilot.specular_share /= kRays;
  if (pilot.met > 0) pilot.met_radiance /= pilot.met;
  return pilot;
}

}  // namespace radfarm
