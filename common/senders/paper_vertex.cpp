#include "senders/paper_vertex.h"

#include <algorithm>

#include "base/check.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "senders/lobe_sums.h"
#include "senders/paper_lines.h"
#include "senders/vertex_sky.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPaperKey = 0x7061706572;  // "paper"
constexpr std::uint64_t kPatchKey = 0x7061746368;  // "patch"
constexpr std::uint64_t kSkyKey = 0x736b79;        // "sky"
constexpr std::uint32_t kReceivers = 16;           // that tell the reflectance around
constexpr std::uint32_t kSelfRays = 100;
constexpr std::uint32_t kMinSamples = 4, kMaxSamples = 64;  // of one sender's classification
constexpr float kMostResampled = 256;              // of one sender at one point
constexpr float kCutShare = 0.5F;                  // of the threshold: how coarse a sender of the cut may be

/// (paper.4) As many samples as the penumbra covers pixels, so that no step is wider than one, or as make each step too small
/// to be seen, whichever is less.
float shadow_samples(const PerspectiveGrid& grid, const Vec3& vertex, float penumbra, float radiance, float threshold) {
  const float pixels = penumbra / grid.pixel_width(vertex);
  const float steps = threshold > 0 ? radiance / threshold : kMostResampled;
  return std::clamp(std::min(pixels, steps), 1.0F, kMostResampled);
}

bool contains_point(const SenderNode& node, const Vec3& point) {
  return node.patch == kNone && node.bounds.intersects(point);
}

/// (paper.3) The light of clusters around the vertex, whose sorted list is `clusters`, by rays in all directions; on surfaces
/// from points of them, in those above.
void add_self(const VertexContext& context, const Surroundings& around, const std::vector<std::uint32_t>& clusters,
              std::uint64_t key, LobeSums& lobes) {
  if (clusters.empty()) return;
  for (std::uint32_t i = 0; i < kSelfRays; ++i) {
    ReceiverPoint from{around.region.center, {0, 0, 0}, 0};
    Vec3 way = normalize(sample_uniform_sphere(sobol_owen_2d(i, key)));
    if (around.is_on_surface()) {
      from = random_receiver(context, around, combine(key, i, kPatchKey));
      if (dot(way, from.normal) < 0) way = -way;
    }
    const auto hit = context.world.caster.closest({from.position, way}, combine(key, i));
    if (!hit) continue;
    SurfacePoint met = context.world.surfaces.at(*hit);
    face(met, -way);
    const std::uint32_t reflector = context.paper->lookup.find(*hit, met);
    if (reflector == kNone) continue;
    const std::uint32_t patch = context.tree.reflectors[reflector].sender;
    std::uint32_t above = patch;
    while (above != kNone && !std::binary_search(clusters.begin(), clusters.end(), above)) above = context.paper->parents[above];
    if (above == kNone) continue;
    // Radiance B / pi times a share of all directions: 4 pi / n, or 2 pi / n.
    const SenderNode& node = context.tree.nodes[patch];
    const float share = (around.is_on_surface() ? 2.0F : 4.0F) / (node.area * kSelfRays);
    lobes.add(way, node.emitted_power * share, node.reflected_power * share);
  }
}

/// Everything about one sender at one vertex.
CriticalSender classify(const VertexContext& context, std::uint32_t id, const Observation& seen, float reflectance,
                        float threshold) {
  const SenderNode& node = context.tree.nodes[id];
  const float radiance = reflectance * kInversePi * node.power;
  const float form_factor_change = radiance * (seen.kernel_max - seen.kernel_min) * seen.visibility;     // eq. 2
  const bool is_partial = seen.visibility > 0 && seen.visibility < 1;
  const float visibility_change = is_partial ? radiance * seen.kernel : 0;                               // eq. 3
  CriticalSender sender;
  sender.node = id;
  sender.resample_form_factor = form_factor_change > threshold ? 1 : 0;
  sender.resample_visibility = visibility_change > threshold ? 1 : 0;
  sender.direction = seen.direction;
  sender.direct = node.emitted_power * seen.strength;
  sender.indirect = node.reflected_power * seen.strength;
  sender.visibility = Spectrum(seen.visibility);
  sender.outline = outline_of(context.tree, id);
  return sender;
}

/// What decides at one vertex besides its surroundings.
struct Judgement {
  float reflectance = 0;  // mean around
  float threshold = 0;    // cd/m^2
  std::uint64_t key = 0;
};

/// Senders by what is done about their light: by lines, or by rays in all directions.
struct Split {
  std::vector<std::uint32_t> apart, around;  // sorted
  double unoccluded = 0;                     // lux, of all of the cut
};

Split split_senders(const VertexContext& context, const Surroundings& around, const Judgement& by) {
  const float change = kCutShare * by.threshold * kPi / std::max(by.reflectance, 1e-3F);
  const std::vector<HalfSpace> above = half_spaces(context, around);
  Split split;
  for (const std::uint32_t id : cut_senders(context.tree, around.region, change, context.settings.max_senders)) {
    const SenderNode& node = context.tree.nodes[id];
    if (is_below(above, node.bounds)) continue;
    split.unoccluded += static_cast<double>(unoccluded(node, around.region));
    (contains_point(node, around.region.center) ? split.around : split.apart).push_back(id);
  }
  return split;
}

VertexSenders classify_all(const VertexContext& context, const Surroundings& around, const Judgement& by) {
  const Split split = split_senders(context, around, by);
  VertexSenders result;
  LobeSums lobes;
  for (const std::uint32_t id : split.apart) {
    const float irradiance = unoccluded(context.tree.nodes[id], around.region);
    const auto share = split.unoccluded > 0 ? static_cast<float>(static_cast<double>(irradiance) / split.unoccluded) : 0;
    const float samples = share * context.settings.paper_samples;                                          // eq. 1
    const std::uint32_t lines = std::clamp(static_cast<std::uint32_t>(samples), kMinSamples, kMaxSamples);
    const Observation seen = observe(context, around, id, lines, combine(by.key, id));
    CriticalSender sender = classify(context, id, seen, by.reflectance, by.threshold);
    if (sender.resample_form_factor == 0 && sender.resample_visibility == 0) {
      lobes.add(sender.direction, sender.direct * sender.visibility, sender.indirect * sender.visibility);
      continue;
    }
    sender.samples = std::clamp(samples, 1.0F, kMostResampled);
    if (sender.resample_visibility != 0) {
      const float radiance = by.reflectance * kInversePi * irradiance;
      sender.samples = shadow_samples(context.grid, around.region.center, seen.penumbra, radiance, by.threshold);
    }
    result.critical.push_back(sender);
  }
  add_self(context, around, split.around, combine(by.key, kPaperKey), lobes);
  result.lobes = lobes.lobes();
  return result;
}

/// Of the grid's vertices around a point.
float threshold_at(const VertexContext& context, const Vec3& position) {
  const Interpolation at = interpolate(context.grid, position);
  float threshold = 0;
  for (std::size_t i = 0; i < 4; ++i) threshold += at.weights[i] * context.thresholds[at.vertices[i]];
  return threshold;
}

}  // namespace

PaperContext::PaperContext(const World& world, const SenderTree& tree, const PerspectiveGrid& grid)
    : lookup(world, tree), closed(world.scene), parents(tree.nodes.size(), kNone), patches(make_patch_mesh(world, tree, grid)) {
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    for (std::uint32_t c = 0; c < tree.nodes[i].child_count; ++c) parents[tree.nodes[i].first_child + c] = i;
  }
}

VertexSenders paper_vertex(const VertexContext& context, std::uint32_t vertex) {
  RADFARM_CHECK(context.paper != nullptr);
  const Surroundings around = around_grid_vertex(context, vertex);
  const std::vector<ReceiverPoint> receivers = receivers_around(context.grid, context.receivers, vertex, kReceivers);
  const std::uint64_t key = combine(context.seed, kPaperKey, vertex);
  VertexSenders result = classify_all(context, around, {mean_reflectance(receivers), context.thresholds[vertex], key});
  result.sky = visible_sky(context.world, receivers, combine(key, kSkyKey));
  return result;
}

VertexSenders paper_patch_vertex(const VertexContext& context, std::uint32_t vertex) {
  RADFARM_CHECK(context.paper != nullptr);
  const Surroundings around = around_patch_vertex(context, vertex);
  const std::uint64_t key = combine(context.seed, kPatchKey, vertex);
  std::vector<ReceiverPoint> receivers;
  for (std::uint32_t i = 0; i < kReceivers; ++i) receivers.push_back(random_receiver(context, around, combine(key, kSkyKey, i)));
  VertexSenders result =
      classify_all(context, around, {mean_reflectance(receivers), threshold_at(context, around.region.center), key});
  result.sky = visible_sky(context.world, receivers, combine(key, kSkyKey));
  return result;
}

}  // namespace radfarm
