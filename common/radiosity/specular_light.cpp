#include "radiosity/specular_light.h"

#include <algorithm>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "paths/photon_path.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kSpecularKey = 0x73706563;  // "spec"
constexpr std::size_t kPaths = 1 << 17;
constexpr std::size_t kGrain = 1024;
constexpr double kMeanHits = 16;  // the instance's mean counts as so many hits of a side

bool sends_specular(const Scene& scene) {
  return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
    const Material& material = scene.materials[scene.meshes[instance.mesh].material];
    return !material.is_lambertian() && !material.folds_specular;
  });
}

struct Arrival {
  std::uint32_t side = kNone;
  Spectrum power;  // lm
};

/// The arrivals of a run of paths, in their order.
std::vector<Arrival> follow_run(const World& world, const SideNumbers& sides, std::uint64_t seed, std::size_t begin, std::size_t end) {
  std::vector<Arrival> arrivals;
  const auto see = [&](const Segment& segment) {
    if (segment.instance == kNone || segment.origin != Origin::kSpecular) return;
    const TriangleVertices p = world.surfaces.triangle(segment.instance, segment.triangle);
    const bool is_front = dot(cross(p[1] - p[0], p[2] - p[0]), segment.end_normal) > 0;
    arrivals.push_back({sides.of(segment.instance, segment.triangle, is_front), segment.power / static_cast<float>(kPaths)});
  };
  for (std::size_t i = begin; i < end; ++i) (void)follow_path(world, combine(seed, kSpecularKey), i, see);
  return arrivals;
}

double area_of(const TriangleVertices& p) {
  return 0.5 * static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0])));
}

/// What sides of one instance received, on its front or its back.
struct SideSums {
  std::vector<SpectrumD> power;  // lm, one a side
  std::vector<std::uint32_t> hits;
};

/// Spreads what the sides of an instance that face one way received over those that received something at all.
void share_instance(const World& world, const SideNumbers& sides, std::uint32_t instance, bool is_front, const SideSums& sums,
                    std::vector<Spectrum>& irradiance) {
  const auto triangles = static_cast<std::uint32_t>(world.scene.meshes[world.scene.instances[instance].mesh].triangles.size());
  SpectrumD power;
  double area = 0;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t side = sides.of(instance, t, is_front);
    power += sums.power[side];
    area += area_of(world.surfaces.triangle(instance, t));
  }
  if (is_black(Spectrum(power)) || !(area > 0)) return;
  const SpectrumD mean = power / area;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t side = sides.of(instance, t, is_front);
    const double own = area_of(world.surfaces.triangle(instance, t)), hits = sums.hits[side];
    const SpectrumD here = own > 0 ? sums.power[side] / own : mean;
    irradiance[side] = Spectrum((mean * kMeanHits + here * hits) / (kMeanHits + hits));
  }
}

}  // namespace

std::vector<Spectrum> specular_irradiance(const World& world, const SideNumbers& sides, std::uint64_t seed) {
  if (!sends_specular(world.scene) || world.emitters.size() == 0) return {};
  std::vector<std::vector<Arrival>> runs(kPaths / kGrain);
  parallel_for(kPaths, kGrain, [&](std::size_t begin, std::size_t end) {
    runs[begin / kGrain] = follow_run(world, sides, seed, begin, end);
  });
  SideSums sums{std::vector<SpectrumD>(sides.count), std::vector<std::uint32_t>(sides.count)};
  for (const std::vector<Arrival>& run : runs) {
    for (const Arrival& arrival : run) {
      sums.power[arrival.side] += SpectrumD(arrival.power);
      ++sums.hits[arrival.side];
    }
  }
  std::vector<Spectrum> irradiance(sides.count);
  for (std::uint32_t instance = 0; instance < world.scene.instances.size(); ++instance) {
    for (const bool is_front : {true, false}) share_instance(world, sides, instance, is_front, sums, irradiance);
  }
  return irradiance;
}

std::vector<Spectrum> specular_at_patches(std::span<const Spectrum> of_sides, const SideNumbers& sides, const Hierarchy& hierarchy) {
  RADFARM_CHECK(of_sides.empty() || of_sides.size() == sides.count);
  if (of_sides.empty()) return {};
  std::vector<Spectrum> irradiance(hierarchy.nodes.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (!is_undivided(node)) continue;
    const Patch& patch = hierarchy.patches[node.patch];
    irradiance[i] = of_sides[sides.of(patch.instance, patch.triangle, patch.is_front != 0)];
  }
  return irradiance;
}

}  // namespace radfarm
