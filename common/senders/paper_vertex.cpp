#include "senders/paper_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "senders/lobe_sums.h"
#include "senders/vertex_sky.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPaperKey = 0x7061706572;  // "paper"
constexpr std::uint64_t kSkyKey = 0x736b79;        // "sky"
constexpr std::uint32_t kReceivers = 16;           // that tell the reflectance around
constexpr std::uint32_t kSelfRays = 100;
constexpr std::uint32_t kMinSamples = 4, kMaxSamples = 64;  // of one sender's classification
constexpr float kMostResampled = 256;              // of one sender at one point
constexpr float kCutShare = 0.5F;                  // of the threshold: how coarse a sender of the cut may be

/// What lines from free space to a sender found.
struct Observation {
  float kernel = 0, kernel_min = 0, kernel_max = 0;  // cos_y / (pi r^2), 1/m^2
  float visibility = 1;
  float penumbra = 0;       // mean width of the shadows' edges, m; 0: none met
  Vec3 direction{0, 0, 1};
};

/// The first surfaces between two points.
struct Line {
  bool is_hidden = false;
  float receiver = 0, occluder = 0;  // distances of the receiver's surface and of what hides it
};

/// The paper's rule for a line from a point in free space: its first hit may be the receiver itself, and the second its back
/// side where it is closed; what is met after that hides it. (paper.2)
Line follow(const VertexContext& context, const Vec3& from, const Vec3& to, std::uint64_t key) {
  const Vec3 way = normalize(to - from);
  const float length_of_line = length(to - from);
  Line line;
  Vec3 origin = from;
  std::uint32_t allowed = 1;
  for (std::uint32_t hits = 0; hits < 3; ++hits) {
    const float gone = dot(origin - from, way);
    const auto hit = context.world.caster.closest({origin, way}, combine(key, hits), length_of_line - gone);
    if (!hit) return line;
    if (hits == 0) line.receiver = hit->distance, allowed = context.paper->closed.is_closed(*hit) ? 2 : 1;
    line.occluder = gone + hit->distance;
    line.is_hidden = hits >= allowed;
    if (line.is_hidden) return line;
    origin = leave(context.world.surfaces.at(*hit), way);
  }
  return line;
}

/// A point evenly over grid coordinates in one of the cells around a vertex.
Vec3 free_point(const PerspectiveGrid& grid, const std::vector<std::uint32_t>& cells, std::uint64_t key) {
  RandomSequence random(key);
  const std::uint32_t cell = cells[random.bits() % cells.size()];
  const std::uint32_t x = cell % grid.columns, y = cell / grid.columns % grid.rows, z = cell / grid.columns / grid.rows;
  const float dx = random.uniform(), dy = random.uniform(), dz = random.uniform();
  return grid.position({static_cast<float>(x) + dx, static_cast<float>(y) + dy, static_cast<float>(z) + dz});
}

Observation observe(const VertexContext& context, const std::vector<std::uint32_t>& cells, std::uint32_t id,
                    std::uint32_t samples, std::uint64_t key) {
  Observation seen;
  seen.kernel_min = std::numeric_limits<float>::infinity();
  double kernel = 0, passed = 0, penumbra = 0;
  std::uint32_t hidden = 0;
  Vec3d direction(0, 0, 0);
  const float width = length(context.tree.nodes[id].bounds.size());
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Vec3 x = free_point(context.grid, cells, combine(key, i));
    const SenderSample y = fixed_sample(context.tree, id, i);
    const Vec3 offset = y.position - x;
    const float squared = dot(offset, offset);
    if (!(squared > 0)) continue;
    const float cosine_y = std::max(0.0F, -dot(y.normal, offset));  // times the distance
    const float k = std::min(cosine_y / (kPi * squared * std::sqrt(squared)), 2 / context.tree.patches[y.patch].area);
    seen.kernel_min = std::min(seen.kernel_min, k), seen.kernel_max = std::max(seen.kernel_max, k);
    if (!(k > 0)) continue;
    kernel += static_cast<double>(k);
    direction += to_double(normalize(offset)) * static_cast<double>(k);
    const Line line = follow(context, x, y.leave(), combine(key, i, 1));
    if (!line.is_hidden) {
      passed += static_cast<double>(k);
      continue;
    }
    const float to_sender = std::max(std::sqrt(squared) - line.occluder, 1e-6F * std::sqrt(squared));
    penumbra += static_cast<double>(width * (line.occluder - line.receiver) / to_sender);
    ++hidden;
  }
  if (!(kernel > 0)) return {};
  const SenderNode& node = context.tree.nodes[id];
  seen.kernel = std::min(static_cast<float>(kernel / samples), node.max_radiosity / node.power);
  seen.visibility = static_cast<float>(passed / kernel);
  seen.penumbra = hidden > 0 ? static_cast<float>(penumbra / hidden) : 0;
  seen.direction = to_float(normalize(direction));
  return seen;
}

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

/// (paper.3) The light of clusters around the vertex, whose sorted list is `clusters`, by rays in all directions.
void add_self(const VertexContext& context, const Vec3& vertex, const std::vector<std::uint32_t>& clusters, std::uint64_t key,
              LobeSums& lobes) {
  if (clusters.empty()) return;
  for (std::uint32_t i = 0; i < kSelfRays; ++i) {
    const Vec3 way = normalize(sample_uniform_sphere(sobol_owen_2d(i, key)));
    const auto hit = context.world.caster.closest({vertex, way}, combine(key, i));
    if (!hit) continue;
    SurfacePoint met = context.world.surfaces.at(*hit);
    face(met, -way);
    const std::uint32_t reflector = context.paper->lookup.find(*hit, met);
    if (reflector == kNone) continue;
    const std::uint32_t patch = context.tree.reflectors[reflector].sender;
    std::uint32_t above = patch;
    while (above != kNone && !std::binary_search(clusters.begin(), clusters.end(), above)) above = context.paper->parents[above];
    if (above == kNone) continue;
    // Radiance B / pi times a share 4 pi / n of all directions.
    const SenderNode& node = context.tree.nodes[patch];
    const float share = 4 / (node.area * kSelfRays);
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
  sender.direct = node.emitted_power * seen.kernel;
  sender.indirect = node.reflected_power * seen.kernel;
  sender.visibility = Spectrum(seen.visibility);
  sender.outline = outline_of(context.tree, id);
  return sender;
}

}  // namespace

PaperContext::PaperContext(const World& world, const SenderTree& tree)
    : lookup(world, tree), closed(world.scene), parents(tree.nodes.size(), kNone) {
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    for (std::uint32_t c = 0; c < tree.nodes[i].child_count; ++c) parents[tree.nodes[i].first_child + c] = i;
  }
}

VertexSenders paper_vertex(const VertexContext& context, std::uint32_t vertex) {
  RADFARM_CHECK(context.paper != nullptr);
  const ReceiverRegion region = region_around(context.grid, vertex);
  const std::vector<ReceiverPoint> receivers = receivers_around(context.grid, context.receivers, vertex, kReceivers);
  const float reflectance = mean_reflectance(receivers), threshold = context.thresholds[vertex];
  const std::vector<std::uint32_t> senders =
      cut_senders(context.tree, region, kCutShare * threshold * kPi / std::max(reflectance, 1e-3F), context.settings.max_senders);
  const std::vector<std::uint32_t> cells = context.grid.cells_around(vertex);
  const std::uint64_t key = combine(context.seed, kPaperKey, vertex);
  double total = 0;
  for (const std::uint32_t id : senders) total += static_cast<double>(unoccluded(context.tree.nodes[id], region));

  VertexSenders result;
  LobeSums lobes;
  std::vector<std::uint32_t> around;
  for (const std::uint32_t id : senders) {
    const SenderNode& node = context.tree.nodes[id];
    if (contains_point(node, region.center)) {
      around.push_back(id);
      continue;
    }
    const float irradiance = unoccluded(node, region);
    const auto share = total > 0 ? static_cast<float>(static_cast<double>(irradiance) / total) : 0;
    const float samples = share * context.settings.paper_samples;                                          // eq. 1
    const std::uint32_t lines = std::clamp(static_cast<std::uint32_t>(samples), kMinSamples, kMaxSamples);
    const Observation seen = observe(context, cells, id, lines, combine(key, id));
    CriticalSender sender = classify(context, id, seen, reflectance, threshold);
    if (sender.resample_form_factor == 0 && sender.resample_visibility == 0) {
      lobes.add(sender.direction, sender.direct * sender.visibility, sender.indirect * sender.visibility);
      continue;
    }
    sender.samples = std::clamp(samples, 1.0F, kMostResampled);
    if (sender.resample_visibility != 0) {
      const float radiance = reflectance * kInversePi * irradiance;
      sender.samples = shadow_samples(context.grid, region.center, seen.penumbra, radiance, threshold);
    }
    result.critical.push_back(sender);
  }
  add_self(context, region.center, around, combine(key, kPaperKey), lobes);
  result.lobes = lobes.lobes();
  result.sky = visible_sky(context.world, receivers, combine(key, kSkyKey));
  return result;
}

}  // namespace radfarm
