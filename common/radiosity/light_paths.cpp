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
#include "radiosity/specular_light.h"
#include "scene/emission_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPathKey = 0x6c70617468;  // "lpath"
constexpr std::size_t kBatch = 1 << 16;           // paths whose hits are held at once
constexpr std::size_t kGrain = 512;
// Where it is less than the square of a reflectance, the power of paths has no finite variance; 1 would let one go on without end.
constexpr float kMaxSurvival = 0.9999F;
constexpr double kBelowOne = 0x1.fffffffffffffp-1;
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
  const SpecularStarts specular;
  double emitted_share;  // of all paths: those that emitters send
  float per_path;
  std::uint64_t key;
};

/// What a surface sends on of the power that arrives at one of its points; the key is the bounce's. Nothing: all is absorbed.
std::optional<EmittedRay> send_on(const SurfacePoint& point, const Spectrum& arrived, const Spectrum& reflected,
                                  std::uint64_t key, std::uint32_t index, Run& run) {
  run.absorbed += static_cast<double>(luminance(arrived) - luminance(reflected));
  run.lost += SpectrumD(arrived - reflected);
  const float survive = std::min(kMaxSurvival, luminance(reflected) / luminance(arrived));
  if (to_unit_float(combine(key, 2, index)) >= survive) return std::nullopt;
  const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(index, combine(key, 3)));
  return EmittedRay{{leave(point), normalize(Frame(point.geometric_normal).to_world(local))}, reflected / survive};
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
  return send_on(point, arrived, reflected, key, index, run);
}

/// Light that specular paths bring, sent on by the surface at which it arrives: the first, as for light that an emitter sent.
std::optional<EmittedRay> start_anew(const Tracer& tracer, double choice, const Vec2& place, std::uint32_t index, Run& run) {
  const SpecularArrival start = tracer.specular.sample(choice, place);
  const Spectrum arrived = start.power * (tracer.per_path / static_cast<float>(1 - tracer.emitted_share));
  run.landed += SpectrumD(arrived);
  return send_on(start.point, arrived, arrived * start.reflectance, combine(tracer.key, 4, 0), index, run);
}

void follow_path(const Tracer& tracer, std::uint32_t index, Run& run) {
  const std::uint64_t key = tracer.key;
  const double choice = static_cast<double>(sobol_owen_1d(index, combine(key, 1))), emitted = tracer.emitted_share;
  const Vec2 place = sobol_owen_2d(index, combine(key, 2));
  const bool is_emitted = choice < emitted;
  std::optional<EmittedRay> light;
  if (is_emitted) {
    light = sample_emission(tracer.world, std::min(choice / emitted, kBelowOne), place, sobol_owen_2d(index, combine(key, 3)));
    light->power *= tracer.per_path / static_cast<float>(emitted);
  } else {
    light = start_anew(tracer, std::min((choice - emitted) / (1 - emitted), kBelowOne), place, index, run);
  }
  for (std::uint32_t bounce = is_emitted ? 0 : 1; light && luminance(light->power) > 0; ++bounce) {
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

PathHits follow_light(const FirstLight& light, const SideNumbers& sides, const Hierarchy& hierarchy, std::size_t paths,
                      std::uint64_t seed, const Progress& progress) {
  PathHits result{std::vector<std::uint32_t>(hierarchy.nodes.size()), std::vector<SpectrumD>(hierarchy.nodes.size())};
  SpecularStarts specular(light, sides, hierarchy);
  const double emitted = light.world.emitters.total_flux, all = emitted + specular.flux();
  const Tracer tracer{light.world, sides, hierarchy, nodes_of_sides(sides, hierarchy), std::move(specular),
                      all > 0 ? emitted / all : 1, 1 / static_cast<float>(paths), combine(seed, kPathKey)};
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
