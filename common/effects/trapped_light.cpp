#include "effects/trapped_light.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/random.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kReflections = 65536;
constexpr std::uint32_t kTries = 64;  // rays from a light until one carries the channel: spots and tables have dark directions
constexpr std::uint64_t kTrappedKey = 0x74726170;  // "trap"

float channel_of(const Spectrum& s, std::uint32_t channel) { return std::array{s.r, s.g, s.b}[channel]; }

/// Emitting triangles, two sides each, whose light is known to get out.
using FreeSides = std::vector<bool>;

struct Walker {
  const World& world;
  std::uint32_t channel;
  FreeSides& free;
};

std::size_t side_of(std::uint32_t triangle, bool is_front) { return 2 * std::size_t{triangle} + (is_front ? 0 : 1); }

Ray scatter(const SurfacePoint& from, RandomSequence& random) {
  const Vec3 local = sample_cosine_hemisphere({random.uniform(), random.uniform()});
  return {leave(from), normalize(Frame(from.geometric_normal).to_world(local))};
}

/// Whether a walk on from `ray` loses less than 1 in all its reflections. Remembers the emitters that it passes otherwise.
bool is_trapped(const Walker& walker, Ray ray, RandomSequence& random) {
  std::vector<std::size_t> passed;
  double lost = 0;
  for (std::uint32_t i = 0; i < kReflections && lost < 1; ++i) {
    const auto hit = walker.world.caster.closest(ray, random.bits());
    if (!hit) {
      lost = 1;
      break;
    }
    SurfacePoint point = walker.world.surfaces.at(*hit);
    face(point, -ray.direction);
    const std::uint32_t emitter = walker.world.emitters.find(hit->instance, hit->triangle);
    if (emitter != kNone) passed.push_back(side_of(emitter, point.is_front));
    if (emitter != kNone && walker.free[passed.back()]) lost = 1;
    lost += std::max(0.0, 1 - static_cast<double>(channel_of(walker.world.surfaces.reflectance(point), walker.channel)));
    ray = scatter(point, random);
  }
  if (lost < 1) return true;
  for (const std::size_t side : passed) walker.free[side] = true;
  return false;
}

bool is_trapped_on(const Walker& walker, std::uint32_t emitter, bool is_front, RandomSequence& random) {
  if (walker.free[side_of(emitter, is_front)]) return false;
  const EmissiveTriangle& t = walker.world.emitters.triangles[emitter];
  const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
  SurfacePoint point = walker.world.surfaces.at({t.instance, t.triangle, b.y, b.z, 0});
  if (!is_front) face(point, -point.geometric_normal);
  return is_trapped(walker, scatter(point, random), random);
}

bool is_trapped_from(const Walker& walker, const PunctualEmitter& light, RandomSequence& random) {
  if (light.kind == PunctualLight::Kind::kDirectional) return false;
  for (std::uint32_t i = 0; i < kTries; ++i) {
    const Vec3 way = sample_uniform_sphere({random.uniform(), random.uniform()});
    if (channel_of(intensity(light, way), walker.channel) > 0) return is_trapped(walker, {light.position, way}, random);
  }
  return false;
}

std::optional<TrappedLight> find_in_channel(const World& world, std::uint32_t channel, std::uint64_t seed) {
  FreeSides free(2 * world.emitters.triangles.size());
  const Walker walker{world, channel, free};
  const auto triangles = static_cast<std::uint32_t>(world.emitters.triangles.size());
  for (std::uint32_t i = 0; i < triangles + world.emitters.punctual.size(); ++i) {
    RandomSequence random(combine(seed, kTrappedKey, channel, i));
    bool found = false;
    if (i < triangles) {
      const EmissiveTriangle& t = world.emitters.triangles[i];
      found = channel_of(t.mean_radiance, channel) > 0 &&
              (is_trapped_on(walker, i, true, random) || (t.both_sides && is_trapped_on(walker, i, false, random)));
    } else {
      found = is_trapped_from(walker, world.emitters.punctual[i - triangles], random);
    }
    if (found) return TrappedLight{i, channel, kReflections};
  }
  return std::nullopt;
}

/// The largest reflectance that any material's base allows.
Spectrum brightest(const Scene& scene) {
  Spectrum most;
  for (const Material& material : scene.materials) {
    const Spectrum c = material.base_color;
    most = {std::max(most.r, c.r), std::max(most.g, c.g), std::max(most.b, c.b)};
  }
  return most;
}

}  // namespace

std::optional<TrappedLight> find_trapped_light(const World& world, std::uint64_t seed) {
  const Spectrum most = brightest(world.scene);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    if (channel_of(most, channel) < 1 - 1.0F / kReflections) continue;
    if (const auto trapped = find_in_channel(world, channel, seed)) return trapped;
  }
  return std::nullopt;
}

}  // namespace radfarm
