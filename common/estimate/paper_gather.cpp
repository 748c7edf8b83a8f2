#include "estimate/paper_gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimate/eye_chain.h"
#include "estimate/off_grid_light.h"
#include "estimate/sky_light.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kFirstSkyDimension = 1U << 16;
constexpr std::uint32_t kSkyLines = 16;

/// A critical sender as one vertex has it, and the vertex's weight at the point.
struct Asked {
  const CriticalSender* sender = nullptr;
  float weight = 0;
};

/// Sums over the fixed sample points of one sender, weighed: kernels with both cosines, and what of them is seen.
struct Sampled {
  float kernel = 0;
  Spectrum visible;
};

/// (paper.5) Of n samples, real, the blend of the means of the first floor(n) and the first ceil(n): the weight of sample i.
float weight_of(std::uint32_t i, float n) {
  const float floor = std::floor(n), part = n - floor;
  const float of_floor = static_cast<float>(i) < floor ? (1 - part) / floor : 0;
  return of_floor + part / (floor + 1);
}

/// cos_x cos_y / (pi r^2), at most 1 / area of the patch, times what the receiver's layers let through.
float kernel_at(const GatherPoint& point, const SenderSample& y) {
  const Vec3 offset = y.position - point.surface.position;
  const float squared = dot(offset, offset);
  const float cosine_x = dot(point.surface.shading_normal, offset), cosine_y = -dot(y.normal, offset);  // times the distance
  const bool faces = cosine_x > 0 && cosine_y > 0 && dot(point.surface.geometric_normal, offset) > 0;
  if (!faces || !(squared > 0)) return 0;
  const float kernel = cosine_x * cosine_y / (kPi * squared * squared);
  return std::min(kernel, 1 / point.context.tree.patches[y.patch].area) * point.bsdf.diffuse_shape(normalize(offset));
}

Sampled sample(const GatherPoint& point, std::uint32_t node, float samples, bool traces) {
  Sampled sum;
  for (std::uint32_t i = 0; static_cast<float>(i) < samples; ++i) {
    const SenderSample y = fixed_sample(point.context.tree, node, i);
    const float kernel = kernel_at(point, y) * weight_of(i, samples);
    ++point.counters.form_factor_samples;
    if (!(kernel > 0)) continue;
    sum.kernel += kernel;
    if (!traces) continue;
    ++point.counters.visibility_rays;
    sum.visible += point.context.world.caster.transmittance(point.start, y.leave()) * kernel;
  }
  return sum;
}

/// What one vertex makes of the samples, by its class. Irradiance.
Arrived light_as_asked(const GatherPoint& point, const CriticalSender& sender, const Sampled& sampled) {
  const SenderNode& node = point.context.tree.nodes[sender.node];
  if (sender.resample_form_factor != 0) {
    const Spectrum factor = sender.resample_visibility != 0 ? sampled.visible : sender.visibility * sampled.kernel;
    return {node.emitted_power * factor, node.reflected_power * factor};
  }
  const Spectrum visibility = sampled.kernel > 0 ? sampled.visible / sampled.kernel : sender.visibility;
  const Spectrum factor = visibility * received_from(point, sender.direction);
  return {sender.direct * factor, sender.indirect * factor};
}

/// One sender that some of the vertices ask for: sampled once, with the number of samples interpolated.
void add_sender(const GatherPoint& point, std::span<const Asked> asked, Arrived& arrived) {
  float samples = 0;
  bool traces = false;
  for (const Asked& one : asked) {
    samples += one.weight * one.sender->samples;
    traces = traces || one.sender->resample_visibility != 0;
  }
  const Sampled sampled = sample(point, asked[0].sender->node, std::max(1.0F, samples), traces);
  for (const Asked& one : asked) {
    const Arrived light = light_as_asked(point, *one.sender, sampled);
    arrived.direct += light.direct * one.weight;
    arrived.indirect += light.indirect * one.weight;
  }
}

/// The vertices whose lists a point blends, and their weights, which add up to 1.
struct Vertices {
  std::array<const VertexSenders*, 4> senders{};
  std::array<float, 4> weights{};
};

/// (paper.8) The corners of the point's patch where that is gathered on, else those of its tetrahedron.
Vertices vertices_around(const GatherPoint& point, std::uint32_t reflector) {
  const SenderGrid& grid = point.context.senders;
  Vertices around;
  if (grid.patches()->has(reflector)) {
    const auto weights = corner_weights(point.context.tree.reflectors[reflector].vertices, point.surface.position);
    for (std::size_t i = 0; i < 3; ++i) {
      around.weights[i] = weights[i];
      if (weights[i] > 0) around.senders[i] = &grid.at_patch_vertex(grid.patches()->corners[reflector][i]);
    }
    return around;
  }
  const Interpolation at = interpolate(grid.grid(), point.surface.position);
  around.weights = at.weights;
  for (std::size_t i = 0; i < 4; ++i) {
    if (at.weights[i] > 0) around.senders[i] = &grid.at(at.vertices[i]);
  }
  return around;
}

/// The lists of the vertices around, blended: what one interpolates and another resamples counts in parts.
Arrived gather_senders(const GatherPoint& point, const Vertices& at) {
  Arrived arrived;
  thread_local std::vector<Asked> asked;  // scratch
  asked.clear();
  for (std::size_t v = 0; v < 4; ++v) {
    if (!(at.weights[v] > 0)) continue;
    const VertexSenders& senders = *at.senders[v];
    for (const Lobe& lobe : senders.lobes) {
      const float received = received_from(point, lobe.direction) * at.weights[v];
      arrived.direct += lobe.direct * received;
      arrived.indirect += lobe.indirect * received;
    }
    for (const CriticalSender& sender : senders.critical) asked.push_back({&sender, at.weights[v]});
  }
  std::stable_sort(asked.begin(), asked.end(), [](const Asked& a, const Asked& b) { return a.sender->node < b.sender->node; });
  for (std::size_t begin = 0, end = 0; begin < asked.size(); begin = end) {
    while (end < asked.size() && asked[end].sender->node == asked[begin].sender->node) ++end;
    add_sender(point, std::span(asked).subspan(begin, end - begin), arrived);
  }
  return arrived;
}

Arrived gather_at(const GatherPoint& point, std::uint32_t reflector) {
  const GatherContext& context = point.context;
  const Vertices at = vertices_around(point, reflector);
  Arrived arrived;
  if (!context.tree.nodes.empty()) arrived = gather_senders(point, at);
  arrived.direct += punctual_light(point);
  if (context.world.environment.is_empty()) return arrived;
  const auto nearest = static_cast<std::size_t>(std::max_element(at.weights.begin(), at.weights.end()) - at.weights.begin());
  arrived.direct += sky_light(point, at.senders[nearest]->sky, kSkyLines, kFirstSkyDimension);
  return arrived;
}

class PaperLight : public GridGather {
 public:
  using GridGather::GridGather;

  Arrived seen(const SeenPoint& at, const PixelSampler& sampler, Counters& counters) const override {
    const GatherPoint point{context_, at.point, at.bsdf, sampler, counters, leave(at.point), 0};
    return gather_at(point, context_.lookup.find(at.hit, at.point));
  }
};

}  // namespace

RadianceParts paper_gather_radiance(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                                    Counters& counters, FirstSurface* first) {
  const PaperLight light(context);
  return trace_eye_chain({context.world, light, context.has_interreflection, first}, camera_ray, sampler, counters);
}

}  // namespace radfarm
