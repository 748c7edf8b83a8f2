#include "radiosity/light_paths.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "paths/light_scattering.h"
#include "scene/emission_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPathKey = 0x6c70617468;  // "lpath"
constexpr std::size_t kBatch = 1 << 16;           // paths whose hits are held at once
constexpr std::size_t kGrain = 512;
// Where it is less than the square of a reflectance, the power of paths has no finite variance; 1 would let one go on without end.
constexpr float kMaxSurvival = 0.9999F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct PathHit {
  std::uint32_t node = kNone;
  Spectrum reflected;  // lm
};

/// What a run of paths met, in their order.
struct Run {
  std::vector<PathHit> hits;
  double absorbed = 0, escaped = 0;  // luminance, lm
  SpectrumD landed, lost;
};

struct Tracer {
  const World& world;
  const SideNumbers& sides;
  const Hierarchy& hierarchy;
  const std::vector<std::uint32_t> node_of_side;
  float per_path;
  std::uint64_t key;
};

/// What a surface sends on of the power that arrives at one of its points, by chance as likely as it is much; the key is the bounce's.
/// Nothing: all is absorbed.
std::optional<EmittedRay> send_on(const Ray& ray, const Spectrum& arrived, const Spectrum& sent, std::uint64_t key,
                                  std::uint32_t index, Run& run) {
  run.absorbed += static_cast<double>(luminance(arrived) - luminance(sent));
  run.lost += SpectrumD(arrived - sent);
  const float survive = std::min(kMaxSurvival, luminance(sent) / luminance(arrived));
  if (to_unit_float(combine(key, 2, index)) >= survive) return std::nullopt;
  return EmittedRay{ray, sent / survive};
}

std::optional<EmittedRay> reflect(const SurfacePoint& point, const Spectrum& arrived, const Spectrum& reflected,
                                  std::uint64_t key, std::uint32_t index, Run& run) {
  const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(index, combine(key, 3)));
  return send_on({leave(point), normalize(Frame(point.geometric_normal).to_world(local))}, arrived, reflected, key, index, run);
}

/// Where gloss is not folded into diffuse, light goes on by one of the surface's lobes.
std::optional<EmittedRay> scatter(const Tracer& tracer, const Hit& hit, const Vec3& back, const Spectrum& arrived,
                                  std::uint64_t key, std::uint32_t index, Run& run) {
  const LightVertex vertex(tracer.world, hit, back);
  const Spectrum left = arrived * tracer.world.surfaces.absorption(vertex.point, hit.distance);
  const ScatteredLight next = scatter_light(vertex, left, {sobol_owen_1d(index, combine(key, 5)), sobol_owen_1d(index, combine(key, 6)),
                                                           sobol_owen_2d(index, combine(key, 3))});
  return send_on(next.ray, arrived, left * next.weight, key, index, run);
}

/// Light on its way meets a surface, or nothing. Returns what goes on.
std::optional<EmittedRay> meet(const Tracer& tracer, const EmittedRay& light, std::uint32_t bounce, std::uint32_t index,
                               Run& run) {
  const std::uint64_t key = combine(tracer.key, 4, bounce);
  Spectrum passed(1.0F);
  const auto hit = tracer.world.caster.closest(light.ray, combine(key, 1, index), kInfinity, &passed);
  const Spectrum arrived = light.power * (hit ? hit->weight : passed);
  run.absorbed += static_cast<double>(luminance(light.power) - luminance(arrived));  // by panes
  if (bounce > 0) run.lost += SpectrumD(hit ? light.power - arrived : light.power);
  if (!hit) {
    run.escaped += static_cast<double>(luminance(arrived));
    return std::nullopt;
  }
  SurfacePoint point = tracer.world.surfaces.at(*hit);
  face(point, -light.ray.direction);
  // The adjoint of reflecting about the shading normal: irradiance counts its cosine. [Veach 1997, 5.3]
  const float cosine = -dot(point.shading_normal, light.ray.direction);
  const float bend = std::max(0.0F, -cosine / dot(point.geometric_normal, light.ray.direction));
  const Spectrum reflected = arrived * tracer.world.surfaces.reflectance(point, cosine) * bend;
  const std::uint32_t leaf = tracer.node_of_side[tracer.sides.of(hit->instance, hit->triangle, point.is_front)];
  if (bounce == 0) run.landed += SpectrumD(arrived);
  if (bounce > 0 && leaf != kNone) run.hits.push_back({part_at(tracer.hierarchy, leaf, point.position), reflected});
  const Material& material = tracer.world.scene.materials[point.material];
  if (material.folds_specular || material.is_lambertian()) return reflect(point, arrived, reflected, key, index, run);
  return scatter(tracer, *hit, -light.ray.direction, arrived, key, index, run);
}

void follow_path(const Tracer& tracer, std::uint32_t index, Run& run) {
  const std::uint64_t key = tracer.key;
  const double choice = static_cast<double>(sobol_owen_1d(index, combine(key, 1)));
  std::optional<EmittedRay> light = sample_emission(tracer.world, choice, sobol_owen_2d(index, combine(key, 2)),
                                                    sobol_owen_2d(index, combine(key, 3)));
  light->power *= tracer.per_path;
  for (std::uint32_t bounce = 0; light && luminance(light->power) > 0; ++bounce) {
    light = meet(tracer, *light, bounce, index, run);
  }
}

void add(const Run& run, PathHits& result) {
  for (const PathHit& hit : run.hits) {
    ++result.count[hit.node];
    result.reflected[hit.node] += SpectrumD(hit.reflected);
  }
  result.absorbed += run.absorbed;
  result.escaped += run.escaped;
  result.landed += run.landed;
  result.lost += run.lost;
}

}  // namespace

PathHits follow_light(const World& world, const SideNumbers& sides, const Hierarchy& hierarchy, std::size_t paths,
                      std::uint64_t seed, const Progress& progress) {
  PathHits result{std::vector<std::uint32_t>(hierarchy.nodes.size()), std::vector<SpectrumD>(hierarchy.nodes.size())};
  const Tracer tracer{world, sides, hierarchy, nodes_of_sides(sides, hierarchy), 1 / static_cast<float>(paths),
                      combine(seed, kPathKey)};
  std::atomic<std::size_t> done = 0;
  for (std::size_t begin = 0; begin < paths && !progress.is_cancelled(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, paths - begin);
    std::vector<Run> runs((count + kGrain - 1) / kGrain);
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
      if (progress.is_cancelled()) return;
      for (std::size_t i = first; i < last; ++i) {
        follow_path(tracer, static_cast<std::uint32_t>(begin + i), runs[first / kGrain]);
      }
      progress.report("radiosity: light paths", done += last - first, paths);
    });
    for (const Run& run : runs) add(run, result);
  }
  return result;
}

void balance(PathHits& hits) {
  const SpectrumD& lost = hits.lost;  // nothing: nothing to go by
  const SpectrumD scale{lost.r > 0 ? hits.landed.r / lost.r : 1, lost.g > 0 ? hits.landed.g / lost.g : 1,
                        lost.b > 0 ? hits.landed.b / lost.b : 1};
  for (SpectrumD& power : hits.reflected) power *= scale;
  if (luminance(lost) > 0) hits.absorbed *= luminance(hits.landed) / luminance(lost);
}

}  // namespace radfarm
