#include "radiosity/reach.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "base/disjoint_sets.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kReachKey = 0x7265616368;  // "reach"
constexpr std::uint32_t kMinRays = 4;
constexpr std::uint32_t kMaxRays = 256;
constexpr double kRaysPerScene = 2e5;  // spread over the area, besides kMinRays a side
constexpr std::uint32_t kRaysPerLight = 8192;

struct Side {
  std::uint32_t instance, triangle;
  bool is_front;
};

// In a list of sides met: the sky.
constexpr std::uint32_t kSky = kNone - 1;

std::uint32_t side_met(const World& world, const SideNumbers& sides, const Ray& ray, std::uint64_t key) {
  const auto hit = world.caster.closest(ray, key);
  if (!hit) return world.environment.is_empty() ? kNone : kSky;
  SurfacePoint point = world.surfaces.at(*hit);
  face(point, -ray.direction);
  return sides.of(hit->instance, hit->triangle, point.is_front);
}

/// A point of the side, its normal turned to it.
SurfacePoint point_on(const World& world, const Side& side, const Vec2& u) {
  const Vec3 b = sample_uniform_triangle(u);
  SurfacePoint point = world.surfaces.at({side.instance, side.triangle, b.y, b.z, 0});
  if (!side.is_front) face(point, -point.geometric_normal);
  return point;
}

struct Rays {
  std::uint32_t first, last;
};

void meet_others(const World& world, const SideNumbers& sides, const Side& side, Rays rays, std::uint64_t key,
                 std::vector<std::uint32_t>& met) {
  for (std::uint32_t i = rays.first; i < rays.last; ++i) {
    const SurfacePoint from = point_on(world, side, sobol_owen_2d(i, combine(key, 1)));
    const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(i, combine(key, 2)));
    const Ray ray{leave(from), normalize(Frame(from.geometric_normal).to_world(local))};
    const std::uint32_t other = side_met(world, sides, ray, combine(key, 3, i));
    if (other != kNone) met.push_back(other);
  }
}

std::vector<Side> list_sides(const Scene& scene, std::uint32_t count) {
  std::vector<Side> list;
  list.reserve(count);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const std::size_t triangles = scene.meshes[scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < triangles; ++t) {
      list.push_back({i, t, true});
      list.push_back({i, t, false});
    }
  }
  return list;
}

double area_of(const World& world, const Side& side) {
  const TriangleVertices v = world.surfaces.triangle(side.instance, side.triangle);
  return length(cross(to_double(v[1]) - to_double(v[0]), to_double(v[2]) - to_double(v[0]))) / 2;
}

/// Sides that a point or spot light's rays meet, or that a directional light shines on.
void mark_lit_by(const World& world, const SideNumbers& sides, const std::vector<Side>& list, const PunctualEmitter& light,
                 std::uint64_t key, DisjointSets& groups, std::vector<bool>& lit) {
  if (light.kind == PunctualLight::Kind::kDirectional) {
    for (std::uint32_t s = 0; s < list.size(); ++s) {
      const SurfacePoint point = point_on(world, list[s], sobol_owen_2d(s, key));
      const PunctualArrival arrival = arrive(light, point.position, world.radius);
      if (dot(point.geometric_normal, arrival.direction) > 0 &&
          !is_black(world.caster.transmittance(leave(point), arrival.target))) {
        lit[groups.root(s)] = true;
      }
    }
    return;
  }
  for (std::uint32_t i = 0; i < kRaysPerLight; ++i) {
    const Ray ray{light.position, sample_uniform_sphere(sobol_owen_2d(i, key))};
    const std::uint32_t met = side_met(world, sides, ray, combine(key, i));
    if (met != kNone && met != kSky) lit[groups.root(met)] = true;
  }
}

/// The number of rays from each side in the first round, by its share of the area.
std::vector<std::uint32_t> share_rays(const World& world, const std::vector<Side>& list) {
  std::vector<double> areas(list.size());
  parallel_for(list.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) areas[s] = area_of(world, list[s]);
  });
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<std::uint32_t> rays(list.size());
  for (std::size_t s = 0; s < rays.size(); ++s) {
    rays[s] = std::clamp(static_cast<std::uint32_t>(total > 0 ? areas[s] / total * kRaysPerScene : 0), 1U, kMaxRays);
  }
  return rays;
}

/// What light has reached so far, and what hangs together.
struct Reach {
  DisjointSets groups;
  std::vector<bool> lit;  // at groups' roots

  void light(std::uint32_t side) { lit[groups.root(side)] = true; }
  void join(std::uint32_t a, std::uint32_t b) {
    const bool is_lit = lit[groups.root(a)] || lit[groups.root(b)];
    groups.join(a, b);
    if (is_lit) light(a);
  }
  bool has(std::uint32_t side) { return lit[groups.root(side)]; }
};

/// Rays from those sides that light has not reached yet.
void join_met(const World& world, const SideNumbers& sides, const std::vector<Side>& list, std::uint64_t seed,
              const std::vector<Rays>& rays, const Progress& progress, Reach& reach) {
  std::vector<std::vector<std::uint32_t>> met(list.size());
  parallel_for(progress, "radiosity: reach", list.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) meet_others(world, sides, list[s], rays[s], combine(seed, kReachKey, s), met[s]);
  });
  for (std::uint32_t s = 0; s < list.size(); ++s) {
    for (const std::uint32_t other : met[s]) other == kSky ? reach.light(s) : reach.join(s, other);
  }
}

void light_emitters(const World& world, const SideNumbers& sides, const std::vector<Side>& list, std::uint64_t seed,
                    Reach& reach) {
  for (const EmissiveTriangle& t : world.emitters.triangles) {
    reach.light(sides.of(t.instance, t.triangle, true));
    if (t.both_sides) reach.light(sides.of(t.instance, t.triangle, false));
  }
  for (std::size_t i = 0; i < world.emitters.punctual.size(); ++i) {
    mark_lit_by(world, sides, list, world.emitters.punctual[i], combine(seed, kReachKey, list.size() + i), reach.groups,
                reach.lit);
  }
}

void light_specular(std::span<const Spectrum> specular, Reach& reach) {
  for (std::uint32_t s = 0; s < specular.size(); ++s) {
    if (!is_black(specular[s])) reach.light(s);
  }
}

/// Sides of groups that are dark so far, of which a point sees an emitter: one so far away or so small that no ray met it.
void mark_lit_directly(const World& world, const std::vector<Side>& list, std::uint64_t key, Reach& reach) {
  if (world.emitters.size() == 0) return;
  std::vector<std::uint32_t> dark;
  for (std::uint32_t s = 0; s < list.size(); ++s) {
    if (!reach.has(s)) dark.push_back(s);
  }
  std::vector<std::uint8_t> sees(dark.size());
  parallel_for(dark.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SurfacePoint point = point_on(world, list[dark[i]], sobol_owen_2d(dark[i], combine(key, 1)));
      const NextEvent event = sample_emitter(world, point, sobol_owen_1d(dark[i], combine(key, 2)),
                                             sobol_owen_2d(dark[i], combine(key, 3)));
      sees[i] = is_black(event.weight) ? 0 : 1;
    }
  });
  for (std::size_t i = 0; i < dark.size(); ++i) {
    if (sees[i] != 0) reach.light(dark[i]);
  }
}

}  // namespace

SideNumbers::SideNumbers(const Scene& scene) {
  std::uint32_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    first_triangle.push_back(triangles);
    triangles += static_cast<std::uint32_t>(scene.meshes[instance.mesh].triangles.size());
  }
  count = 2 * triangles;
}

std::vector<bool> reachable_sides(const World& world, const SideNumbers& sides, std::uint64_t seed, const Progress& progress,
                                  std::span<const Spectrum> specular) {
  RADFARM_CHECK(specular.empty() || specular.size() == sides.count);
  const std::vector<Side> list = list_sides(world.scene, sides.count);
  Reach reach{DisjointSets(list.size()), std::vector<bool>(list.size())};
  light_emitters(world, sides, list, seed, reach);
  light_specular(specular, reach);
  const std::vector<std::uint32_t> counts = share_rays(world, list);
  std::vector<Rays> rays(list.size());
  for (std::size_t s = 0; s < rays.size(); ++s) rays[s] = {0, counts[s]};
  join_met(world, sides, list, seed, rays, progress, reach);
  for (std::uint32_t s = 0; s < list.size(); ++s) rays[s] = {counts[s], reach.has(s) ? 0 : std::max(counts[s], kMinRays)};
  join_met(world, sides, list, seed, rays, progress, reach);
  mark_lit_directly(world, list, combine(seed, kReachKey, kNone), reach);
  std::vector<bool> reached(list.size());
  for (std::uint32_t s = 0; s < list.size(); ++s) reached[s] = reach.has(s);
  return reached;
}

}  // namespace radfarm
