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
constexpr float kMaxSurvival = 0.99F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// 25 % noise: below that, the guess says better how a node's light is shared.
constexpr std::uint32_t kEnoughHits = 16;
// This share of the guess is spread evenly: links may have left dark what paths meet.
constexpr double kEvenShare = 0.05;

/// Which node holds each side's patch; kNone for sides left out.
std::vector<std::uint32_t> nodes_of_sides(const SideNumbers& sides, const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> nodes(sides.count, kNone);
  for (const std::uint32_t leaf : hierarchy.leaves) {
    const Patch& patch = hierarchy.patches[hierarchy.nodes[leaf].patch];
    nodes[sides.of(patch.instance, patch.triangle, patch.is_front != 0)] = leaf;
  }
  return nodes;
}

struct PathHit {
  std::uint32_t node = kNone;
  Spectrum reflected;  // lm
};

/// What a run of paths met, in their order.
struct Run {
  std::vector<PathHit> hits;
  double absorbed = 0, escaped = 0;  // luminance, lm
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
}

SpectrumD ratio(const SpectrumD& a, const SpectrumD& b) {
  return {b.r > 0 ? a.r / b.r : 0, b.g > 0 ? a.g / b.g : 0, b.b > 0 ? a.b / b.b : 0};
}

template <typename T>
T total(const std::vector<T>& values) {
  T sum{};
  for (const T& value : values) sum += value;
  return sum;
}

/// The guess at undivided patches, scaled to the power that the paths found, a little of it evenly spread.
std::vector<SpectrumD> scale_guess(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& guess) {
  std::vector<SpectrumD> scaled(guess.size());
  SpectrumD even;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (node.child_count > 0) continue;
    scaled[i] = SpectrumD(guess[i]);
    even += SpectrumD(node.reflectance) * static_cast<double>(node.area);
  }
  const SpectrumD found = total(hits.reflected);
  const SpectrumD scale = ratio(found, total(scaled)) * (1 - kEvenShare), even_scale = ratio(found, even) * kEvenShare;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (node.child_count > 0) continue;
    scaled[i] = scaled[i] * scale + even_scale * SpectrumD(node.reflectance) * static_cast<double>(node.area);
  }
  return scaled;
}

/// Hits and power of all that lies below each node.
struct Sums {
  std::vector<std::uint32_t> count;
  std::vector<SpectrumD> found;
  std::vector<SpectrumD> likely;
};

void pull_up(const Hierarchy& hierarchy, Sums& sums) {
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) {
    const std::uint32_t parent = hierarchy.nodes[i].parent;
    sums.count[parent] += sums.count[i];
    sums.found[parent] += sums.found[i];
    sums.likely[parent] += sums.likely[i];
  }
}

/// The children that got few hits share what they got together as is likely.
void scale_few(const Sums& sums, const Node& node, std::vector<SpectrumD>& scale,
               std::vector<bool>& is_scaled) {
  SpectrumD found, likely;
  const auto few = [&](std::uint32_t child) { return sums.count[child] < kEnoughHits; };
  for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
    if (few(c)) found += sums.found[c], likely += sums.likely[c];
  }
  for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
    if (few(c)) scale[c] = ratio(found, likely), is_scaled[c] = true;
  }
}

/// Down the tree: nodes with enough hits keep the power found.
std::vector<Spectrum> distribute(const Hierarchy& hierarchy, const Sums& sums) {
  std::vector<SpectrumD> scale(hierarchy.nodes.size());
  std::vector<bool> is_scaled(hierarchy.nodes.size());
  std::vector<Spectrum> power(hierarchy.nodes.size());
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (i > 0 && is_scaled[node.parent]) {
      scale[i] = scale[node.parent];
      is_scaled[i] = true;
    } else if (!is_scaled[i] && node.child_count > 0) {
      scale_few(sums, node, scale, is_scaled);
    } else if (!is_scaled[i]) {
      scale[i] = ratio(sums.found[i], sums.likely[i]);
    }
    if (node.child_count == 0) power[i] = Spectrum(sums.likely[i] * scale[i]);
  }
  return power;
}

}  // namespace

PathHits follow_light(const World& world, const SideNumbers& sides, const Hierarchy& hierarchy, std::size_t paths,
                      std::uint64_t seed) {
  PathHits result{std::vector<std::uint32_t>(hierarchy.nodes.size()), std::vector<SpectrumD>(hierarchy.nodes.size())};
  const Tracer tracer{world, sides, hierarchy, nodes_of_sides(sides, hierarchy), 1 / static_cast<float>(paths),
                      combine(seed, kPathKey)};
  for (std::size_t begin = 0; begin < paths; begin += kBatch) {
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

std::vector<Spectrum> combine_with_guess(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& guess) {
  Sums sums{hits.count, hits.reflected, scale_guess(hierarchy, hits, guess)};
  const double found = luminance(total(hits.reflected));
  std::uint64_t count = 0;
  for (const std::uint32_t c : hits.count) count += c;
  const double hits_per_lumen = found > 0 ? static_cast<double>(count) / found : 0;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const double expected = luminance(sums.likely[i]) * hits_per_lumen;
    sums.likely[i] = (sums.likely[i] + hits.reflected[i] * expected) / (expected + 1);
  }
  pull_up(hierarchy, sums);
  return distribute(hierarchy, sums);
}

}  // namespace radfarm
