#include "radiosity/direct.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kDirectKey = 0x646972;  // "dir"
constexpr std::uint32_t kMinSamples = 4;
constexpr std::uint32_t kMaxSamples = 256;
constexpr float kSamplesPerScene = 4e5F;  // spread over the area, besides kMinSamples a patch

Spectrum sample_patch(const World& world, const Patch& patch, std::uint32_t samples, std::uint64_t key) {
  SpectrumD sum;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Vec3 b = sample_uniform_triangle(sobol_owen_2d(i, combine(key, 1)));
    SurfacePoint point;
    point.position = patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z;
    point.geometric_normal = point.shading_normal = patch.normal;
    point.offset = patch.offset;
    const NextEvent event = sample_emitter(world, point, sobol_owen_1d(i, combine(key, 2)), sobol_owen_2d(i, combine(key, 3)));
    sum += SpectrumD(event.weight * std::max(0.0F, dot(patch.normal, event.direction)));
  }
  return Spectrum(sum / static_cast<double>(samples));
}

}  // namespace

void sample_direct(const World& world, const Hierarchy& hierarchy, std::uint64_t seed, std::vector<Spectrum>& direct) {
  direct.resize(hierarchy.nodes.size(), kNotSampled);
  const float per_area = kSamplesPerScene / hierarchy.nodes[0].area;
  parallel_for(hierarchy.nodes.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Node& node = hierarchy.nodes[i];
      if (node.is_cluster() || node.child_count > 0 || direct[i] != kNotSampled) continue;
      const auto samples = std::clamp(static_cast<std::uint32_t>(node.area * per_area), kMinSamples, kMaxSamples);
      direct[i] = sample_patch(world, hierarchy.patches[node.patch], samples, combine(seed, kDirectKey, i));
    }
  });
}

}  // namespace radfarm
