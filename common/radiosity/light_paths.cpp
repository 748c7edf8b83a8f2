#include "radiosity/light_paths.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
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

void follow_path(const Tracer& tracer, std::uint32_t index, Run& run) {
  const std::uint64_t key = tracer.key;
  const EmittedRay start = sample_emission(tracer.world, static_cast<double>(sobol_owen_1d(index, combine(key, 1))),
                                           sobol_owen_2d(index, combine(key, 2)), sobol_owen_2d(index, combine(key, 3)));
  Ray ray = start.ray;
  Spectrum power = start.power * tracer.per_path;
  for (std::uint32_t bounce = 0; luminance(power) > 0; ++bounce) {
    const std::uint64_t bounce_key = combine(key, 4, bounce);
    Spectrum passed(1.0F);
    const auto hit = tracer.world.caster.closest(ray, combine(bounce_key, 1, index), kInfinity, &passed);
    const Spectrum left = power * (hit ? hit->weight : passed);
    run.absorbed += static_cast<double>(luminance(power) - luminance(left));  // by panes
    if (bounce > 0) run.lost += SpectrumD(hit ? power - left : power);
    power = left;
    if (!hit) {
      run.escaped += static_cast<double>(luminance(power));
      return;
    }
    SurfacePoint point = tracer.world.surfaces.at(*hit);
    face(point, -ray.direction);
    // The adjoint of reflecting about the shading normal: irradiance counts its cosine. [Veach 1997, 5.3]
    const float bend = std::max(0.0F, dot(point.shading_normal, ray.direction) / dot(point.geometric_normal, ray.direction));
    const float cosine = -dot(point.shading_normal, ray.direction);
    const Spectrum reflected = power * tracer.world.surfaces.reflectance(point, cosine) * bend;
    const std::uint32_t leaf = tracer.node_of_side[tracer.sides.of(hit->instance, hit->triangle, point.is_front)];
    run.absorbed += static_cast<double>(luminance(power) - luminance(reflected));
    if (bounce == 0) run.landed += SpectrumD(power);
    run.lost += SpectrumD(power - reflected);
    if (bounce > 0 && leaf != kNone) run.hits.push_back({part_at(tracer.hierarchy, leaf, point.position), reflected});
    const float survive = std::min(kMaxSurvival, luminance(reflected) / luminance(power));
    if (to_unit_float(combine(bounce_key, 2, index)) >= survive) return;
    power = reflected / survive;
    const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(index, combine(bounce_key, 3)));
    ray = {leave(point), normalize(Frame(point.geometric_normal).to_world(local))};
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
  for (std::size_t begin = 0; begin < paths && !progress.is_cancelled(); begin += kBatch) {
    progress.report("radiosity: light paths", begin, paths);
    const std::size_t count = std::min(kBatch, paths - begin);
    std::vector<Run> runs((count + kGrain - 1) / kGrain);
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        follow_path(tracer, static_cast<std::uint32_t>(begin + i), runs[first / kGrain]);
      }
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
