#include "senders/vertex_senders.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "math/sobol.h"
#include "senders/lobe_sums.h"
#include "senders/vertex_sky.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kVertexKey = 0x76657274;  // "vert"
constexpr std::uint64_t kSkyKey = 0x736b79;       // "sky"
constexpr std::uint32_t kReceivers = 16;
constexpr std::uint32_t kMinSamples = 4;
constexpr std::uint32_t kMaxSamples = 64;
constexpr float kCutShare = 0.5F;       // of the threshold: how coarse a sender of the cut may be

// A sender that the vertex's lines saw hidden is sampled as if this share of it were seen.
constexpr float kLeastPrior = 0.2F;

/// What a handful of lines from receivers to a sender found.
struct Observation {
  float kernel = 0;                  // mean of cos_y / (pi r^2), 1/m^2
  float kernel_min = 0, kernel_max = 0;
  float visibility = 1;              // kernel-weighted, luminance
  Spectrum passed{1.0F};             // the same by colour
  Vec3 direction{0, 0, 1};
  float angle = 0;                   // mean angular radius of the sender, radians, at most 1
  float hidden_kernel = 0;           // mean kernel of lines below their receivers' horizons
  std::uint32_t above = 0;           // lines above their receivers' horizons
};

Observation observe(const VertexContext& context, const std::vector<ReceiverPoint>& receivers, std::uint32_t id,
                    std::uint32_t samples, float near_distance, std::uint64_t key) {
  Observation seen;
  seen.kernel_min = std::numeric_limits<float>::infinity();
  const float radius = length(context.tree.nodes[id].bounds.size()) / 2;
  double kernel = 0, hidden = 0, angle = 0;
  SpectrumD passed;
  Vec3d direction(0, 0, 0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const ReceiverPoint& x = receivers[i % receivers.size()];
    const SenderSample y = sample_sender(context.tree, id, sobol_owen_1d(i, combine(key, 1)),
                                         sobol_owen_2d(i, combine(key, 2)));
    const Vec3 offset = y.position - x.position;
    const float squared = dot(offset, offset);
    // A sender below a receiver's horizon sends it nothing, and says nothing of what its neighbours get.
    const bool is_above = x.normal == Vec3(0, 0, 0) || dot(x.normal, offset) > 0;
    if (!(squared > 0)) continue;
    const float cosine_y = std::max(0.0F, -dot(y.normal, offset));  // times the distance
    // A patch fills at most half of all directions, 2 pi / pi = 2, however close it is.
    const float k = std::min(cosine_y / (kPi * squared * std::sqrt(squared)), 2 / context.tree.patches[y.patch].area);
    if (!is_above) {
      hidden += static_cast<double>(k);
      continue;
    }
    ++seen.above;
    // What only reflects and is near is not a sender's to give: rays bring it.
    const bool is_near = context.tree.patches[y.patch].emits == 0 && squared < near_distance * near_distance;
    seen.kernel_min = std::min(seen.kernel_min, is_near ? 0 : k);
    seen.kernel_max = std::max(seen.kernel_max, k);
    if (is_near) continue;
    kernel += static_cast<double>(k);
    angle += static_cast<double>(std::min(1.0F, radius / std::sqrt(squared)));
    direction += to_double(normalize(offset)) * static_cast<double>(k);
    if (k > 0) passed += SpectrumD(context.world.caster.transmittance(x.position, y.leave()) * k);
  }
  seen.hidden_kernel = static_cast<float>(hidden / samples);
  if (!(kernel > 0)) {
    seen.kernel_min = seen.visibility = 0;
    seen.passed = {};
    return seen;
  }
  // However near, a sender gives no more than its largest radiosity.
  const SenderNode& node = context.tree.nodes[id];
  seen.kernel = std::min(static_cast<float>(kernel / seen.above), node.max_radiosity / node.power);
  seen.angle = static_cast<float>(angle / seen.above);
  seen.passed = Spectrum(passed / kernel);
  seen.visibility = luminance(seen.passed);
  seen.direction = to_float(normalize(direction));
  return seen;
}

/// A sender as its first samples judge it: the largest changes of radiance that interpolating it may cause.
struct Judged {
  std::uint32_t node = 0;
  std::uint32_t samples = 0;
  float form_factor_change = 0;  // (senders.2)
  float visibility_change = 0;   // (senders.3)
  float prior = 1;               // share of the sender expected to be seen
  Spectrum visibility{1.0F};     // as the deciding samples saw it
  float change() const { return std::max(form_factor_change, visibility_change); }
};

Judged judge(const SenderNode& node, std::uint32_t id, std::uint32_t samples, const Observation& seen, float reflectance) {
  const float radiance = reflectance * kInversePi * node.power;
  // Eq. 2 leaves the receiver's cosine out; over a wide sender it varies by about the angle the sender subtends.
  const float kernel_change = std::max(seen.kernel_max - seen.kernel_min, 0.5F * seen.kernel * seen.angle);
  const bool is_partial = seen.visibility > 0 && seen.visibility < 1;
  if (seen.above == 0) {
    // No receiver met faces the sender, but a point beside them may (the side of a window bar): unknown, so resampled.
    const float unknown = radiance * seen.hidden_kernel;
    return {id, samples, unknown, unknown, 1, {}};
  }
  // N lines that all met the same say that one in N + 2 others may not.
  const float unseen = is_partial ? 1 : 1 / static_cast<float>(seen.above + 2);
  return {id, samples, radiance * kernel_change * std::max(seen.visibility, unseen),
          radiance * seen.kernel * unseen,
          kLeastPrior + (1 - kLeastPrior) * seen.visibility, seen.passed};
}

/// Direct light makes the contrasts that people see, and an emitter that all receivers met see may be hidden from a point
/// beside them: what emits is interpolated only where its unoccluded light is below the threshold. So are bright surfaces that are
/// senders among others which are not: they glow like lamps.
void distrust_bright(const SenderNode& node, SenderChoice choice, const ReceiverRegion& region, float reflectance,
                     Judged& judged) {
  if (is_black(node.emitted_power) && choice == SenderChoice::kAll) return;
  const float unoccluded_radiance = reflectance * kInversePi * unoccluded(node, region);
  judged.form_factor_change = std::max(judged.form_factor_change, unoccluded_radiance);
  judged.visibility_change = std::max(judged.visibility_change, unoccluded_radiance);
  judged.prior = 1;
}

/// Whether a part of the sender may be nearer than `near_distance` to a point of the region.
bool may_be_near(const SenderNode& node, const ReceiverRegion& region, float near_distance) {
  const Vec3 gap = gap_to_box(region.center - node.bounds.center(), node.bounds.size() * 0.5F);
  return length(gap) < near_distance + region.radius;
}

/// The change above which a sender is critical: the threshold, or less where many small changes would add up to more than
/// kMaxTail thresholds. (senders.4)
float critical_change(const std::vector<Judged>& senders, float threshold) {
  std::vector<float> changes;
  for (const Judged& sender : senders) changes.push_back(sender.change());
  std::sort(changes.begin(), changes.end());
  double sum = 0;
  for (const float change : changes) {
    sum += static_cast<double>(change);
    if (change > threshold || sum > static_cast<double>(kMaxTail * threshold)) return std::min(threshold, std::nextafter(change, 0.0F));
  }
  return threshold;
}

void count_class(const CriticalSender& sender, SenderClasses& classes) {
  const bool form_factor = sender.resample_form_factor != 0, visibility = sender.resample_visibility != 0;
  if (form_factor) ++(visibility ? classes.both : classes.form_factor);
  else ++(visibility ? classes.visibility : classes.interpolated);
}

/// What is interpolated comes from samples that had no part in the decision to interpolate: among senders judged by four
/// lines, those whose lines happened to miss are interpolated and those whose lines hit are resampled, so the deciding
/// samples are biased towards the dark.
void measure(const SenderNode& node, const Observation& seen, CriticalSender& sender) {
  sender.direction = seen.direction;
  sender.direct = node.emitted_power * seen.kernel;
  sender.indirect = node.reflected_power * seen.kernel;
  sender.visibility = seen.passed;
}

}  // namespace

ReceiverRegion region_around(const PerspectiveGrid& grid, std::uint32_t vertex) {
  ReceiverRegion region{grid.vertex_position(vertex), 0};
  const auto [i, j, k] = grid.vertex_indices(vertex);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t x = (corner & 1U) != 0 ? std::min(i + 1, grid.columns) : i - (i > 0 ? 1 : 0);
    const std::uint32_t y = (corner & 2U) != 0 ? std::min(j + 1, grid.rows) : j - (j > 0 ? 1 : 0);
    const std::uint32_t z = (corner & 4U) != 0 ? std::min(k + 1, grid.slices) : k - (k > 0 ? 1 : 0);
    region.radius = std::max(region.radius, length(grid.vertex_position(grid.vertex_id(x, y, z)) - region.center));
  }
  return region;
}

float unoccluded(const SenderNode& node, const ReceiverRegion& region) {
  const Vec3 offset = region.center - node.bounds.center();
  const float reach = std::max(length(offset), length(node.bounds.size()) / 2);
  return node.power / (kPi * std::max(reach * reach, 1e-30F));
}

VertexSenders vertex_senders(const VertexContext& context, std::uint32_t vertex) {
  const ReceiverRegion region = region_around(context.grid, vertex);
  const std::vector<ReceiverPoint> receivers = receivers_around(context.grid, context.receivers, vertex, kReceivers);
  const float reflectance = mean_reflectance(receivers);
  const float max_irradiance = kCutShare * context.thresholds[vertex] * kPi / std::max(reflectance, 1e-3F);
  const std::vector<std::uint32_t> senders =
      cut_senders(context.tree, region, max_irradiance, context.settings.max_senders);
  const float near_distance = radfarm::near_distance(context.tree, context.grid, region.center);
  double total = 0;
  for (const std::uint32_t id : senders) total += static_cast<double>(unoccluded(context.tree.nodes[id], region));

  std::vector<Judged> judged;
  const auto key_of = [&](std::uint32_t id) { return combine(context.seed, kVertexKey, vertex, id); };
  for (const std::uint32_t id : senders) {
    const SenderNode& node = context.tree.nodes[id];
    const double share = total > 0 ? static_cast<double>(unoccluded(node, region)) / total : 0;
    const auto samples = std::clamp(static_cast<std::uint32_t>(share * context.settings.vertex_samples), kMinSamples,
                                    kMaxSamples);
    judged.push_back(judge(node, id, samples, observe(context, receivers, id, samples, near_distance, combine(key_of(id), 1)), reflectance));
    distrust_bright(node, context.tree.choice, region, reflectance, judged.back());
  }
  const float threshold = critical_change(judged, context.thresholds[vertex]);

  VertexSenders result;
  LobeSums lobes;
  for (const Judged& sender : judged) {
    const SenderNode& node = context.tree.nodes[sender.node];
    CriticalSender critical;
    critical.node = sender.node;
    critical.resample_form_factor = sender.form_factor_change > threshold ? 1 : 0;
    critical.resample_visibility = sender.visibility_change > threshold ? 1 : 0;
    // Which part of it is near differs from point to point.
    if (sender.change() > threshold && may_be_near(node, region, near_distance)) {
      critical.resample_form_factor = critical.resample_visibility = 1;
    }
    count_class(critical, result.classes);
    critical.outline = outline_of(context.tree, sender.node);
    critical.prior = sender.prior;
    critical.visibility = sender.visibility;
    const bool needs_both = critical.resample_form_factor != 0 && critical.resample_visibility != 0;
    if (!needs_both) {
      measure(node, observe(context, receivers, sender.node, sender.samples, near_distance, combine(key_of(sender.node), 2)), critical);
    }
    if (critical.resample_form_factor == 0 && critical.resample_visibility == 0) {
      lobes.add(critical.direction, critical.direct * critical.visibility, critical.indirect * critical.visibility);
    } else {
      result.critical.push_back(critical);
    }
  }
  result.lobes = lobes.lobes();
  result.sky = visible_sky(context.world, receivers, combine(context.seed, kVertexKey, vertex, kSkyKey));
  return result;
}

}  // namespace radfarm
