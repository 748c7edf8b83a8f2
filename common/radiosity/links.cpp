#include "radiosity/links.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "math/polygon_irradiance.h"
#include "math/sobol.h"
#include "radiosity/oracles.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMaxSamples = 64;
constexpr std::uint32_t kSkyLines = 16;  // of each point of a receiver
constexpr std::uint32_t kSunLines = 2;
constexpr std::uint64_t kLinkKey = 0x6c696e6b;  // "link"

/// What the lines between two elements found.
struct Lines {
  std::array<float, kMaxSamples> carried{};  // kernel x visibility, receiver cosine included
  std::uint32_t count = 0;
  double unoccluded = 0;    // sums over the lines
  double arrived = 0;
  double cosine = 0;
  Vec3d direction{0, 0, 0};
  float occluder = 0;

  double mean(double sum) const { return sum / static_cast<double>(count); }
  /// What the oracle says. A cluster that N lines saw dark may still be seen by the next one, with the kernel that is typical
  /// of the pair: `typical` is 0 for pairs of patches, whose kernel varies little. The paper's forms know no such bound.
  float error(const LinkOracle& oracle, float receiver_area, float typical) const {
    const auto samples = std::span(carried).first(count);
    if (oracle.form == OracleForm::kLiteral) {
      return static_cast<float>(literal_kernel(oracle.criterion, samples, static_cast<double>(receiver_area)));
    }
    const double unseen = typical > 0 ? std::max(mean(unoccluded), static_cast<double>(typical)) / count : 0;
    return static_cast<float>(std::max(misplaced_kernel(oracle.criterion, samples), unseen));
  }
};

/// A quarter of the kernel between the centres: what two elements of random orientation exchange.
float typical_kernel(const Node& receiver, const Node& sender) {
  if (!receiver.is_cluster() && !sender.is_cluster()) return 0;
  const Vec3 offset = sender.bounds.center() - receiver.bounds.center();
  return 0.25F * std::min(1 / (kPi * std::max(dot(offset, offset), 1e-30F)), 1 / sender.area);
}

/// Whether every point of `box` lies behind the plane of the patch.
bool is_behind(const Patch& patch, const Box3& box) {
  const Vec3 half = box.size() * 0.5F;
  const float reach = std::fabs(patch.normal.x) * half.x + std::fabs(patch.normal.y) * half.y +
                      std::fabs(patch.normal.z) * half.z;
  return dot(patch.normal, box.center() - patch.vertices[0]) + reach <= patch.offset;
}

/// Whether no patch of `a` can face any point of `b`, by cone and bounding spheres or by the patch's plane.
bool looks_away(const Hierarchy& hierarchy, const Node& a, const Node& b) {
  if (!a.is_cluster()) return is_behind(hierarchy.patches[a.patch], b.bounds);
  if (a.cone_cosine <= -1) return false;
  const Vec3 offset = b.bounds.center() - a.bounds.center();
  const float distance = length(offset);
  const float radii = 0.5F * (length(a.bounds.size()) + length(b.bounds.size()));
  if (!(distance > radii)) return false;
  const float angle = std::acos(std::clamp(dot(a.cone_axis, offset) / distance, -1.0F, 1.0F));
  return angle - std::acos(a.cone_cosine) - std::asin(radii / distance) > kPi / 2;
}

/// Blocked lines tell how far the nearest occluder is from the receiver.
float occluder_distance(const World& world, const Vec3& from, const Vec3& to) {
  const auto hit = world.caster.closest({from, normalize(to - from)}, 0);
  return hit ? hit->distance : 0;
}

void add_line(const World& world, Lines& lines, float kernel, float cosine, const Vec3& from, const Vec3& to) {
  const std::uint32_t line = lines.count++;
  lines.cosine += static_cast<double>(std::max(0.0F, cosine));
  if (!(kernel > 0)) return;
  const float visible = luminance(world.caster.transmittance(from, to));
  lines.carried[line] = kernel * visible;
  lines.unoccluded += static_cast<double>(kernel);
  lines.arrived += static_cast<double>(kernel * visible);
  lines.direction += to_double(normalize(to - from)) * static_cast<double>(kernel);
  if (visible == 0 && lines.occluder == 0) lines.occluder = occluder_distance(world, from, to);
}

/// F(x, patch) / A at one receiver point, 1/m^2: the exact mean of the kernel over the sampled patch, so that no distance,
/// however small, makes it large.
float kernel_at(const Hierarchy& hierarchy, const NodeSample& x, const NodeSample& y) {
  const Vec3 offset = y.position - x.position;
  if (!(dot(x.normal, offset) > 0 && dot(y.normal, offset) < 0)) return 0;
  const Patch& patch = hierarchy.patches[y.patch];
  return fast_polygon_form_factor(patch.vertices, x.position, x.normal) / area_of(patch.vertices);
}

/// A cluster's light to itself has no single direction: it counts as the mean irradiance of its surfaces, cosine included.
bool needs_direction(const Node& receiver, const Node& sender) { return receiver.is_cluster() && &receiver != &sender; }

Lines draw_lines(const World& world, const Hierarchy& hierarchy, const Node& receiver, const Node& sender, SampleBy by,
                 std::uint32_t samples, std::uint64_t key) {
  Lines lines;
  for (std::uint32_t i = 0; i < std::min(samples, kMaxSamples); ++i) {
    const NodeSample x = sample_node(hierarchy, receiver, SampleBy::kArea,
                                     static_cast<double>(sobol_owen_1d(i, combine(key, 1))),
                                     sobol_owen_2d(i, combine(key, 2)));
    const NodeSample y = sample_node(hierarchy, sender, by, static_cast<double>(sobol_owen_1d(i, combine(key, 3))),
                                     sobol_owen_2d(i, combine(key, 4)));
    const Vec3 to_sender = normalize(y.position - x.position);
    add_line(world, lines, kernel_at(hierarchy, x, y), dot(x.normal, to_sender), x.leave(), y.leave());
  }
  return lines;
}

/// One point's light from the sky's map or from its sun, as one line.
void add_sky_lines(const World& world, bool is_map, const NodeSample& x, std::uint64_t key, Lines& lines) {
  const auto patches = static_cast<std::uint32_t>(world.environment.patches().size());
  const std::uint32_t sun = world.environment.has_sun() ? 1 : 0;
  const std::uint32_t count = is_map ? kSkyLines : kSunLines;
  if (is_map ? patches == sun : sun == 0) return;
  float unoccluded = 0, arrived = 0, facing = 0;
  Vec3 direction(0, 0, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 u = sobol_owen_2d(i, key);
    const auto sky = is_map ? world.environment.sample_map(static_cast<double>(sobol_owen_1d(i, combine(key, 1))), u)
                            : world.environment.sample_patch(patches - 1, u);
    const float cosine = dot(x.normal, sky.direction);
    const float normal = sky.pdf > 0 ? luminance(sky.radiance) / (sky.pdf * static_cast<float>(count)) : 0;
    facing += normal;
    if (!(cosine > 0 && normal > 0)) continue;
    const Vec3 start = x.leave();
    unoccluded += normal * cosine;
    arrived += normal * cosine * luminance(world.caster.transmittance(start, beyond_scene(world, start, sky.direction)));
    direction += sky.direction * (normal * cosine);
  }
  lines.cosine += facing > 0 ? static_cast<double>(unoccluded / facing) : 0;
  lines.carried[lines.count++] = arrived;
  lines.unoccluded += static_cast<double>(unoccluded);
  lines.arrived += static_cast<double>(arrived);
  lines.direction += to_double(direction);
}

/// Turns sums over lines into a transport factor: at normal incidence, or with the receiver's cosine included.
float transport(const Lines& lines, bool at_normal_incidence) {
  if (!at_normal_incidence) return static_cast<float>(lines.mean(lines.arrived));
  return lines.cosine > 0 ? static_cast<float>(lines.arrived / lines.cosine) : 0;
}

void merge_geometry(const Lines& lines, Link& link) {
  if (lines.unoccluded > 0) {
    link.direction = to_float(normalize(lines.direction));
    link.visibility = static_cast<float>(lines.arrived / lines.unoccluded);
  }
  if (lines.occluder > 0) link.occluder_distance = lines.occluder;
}

}  // namespace

bool cannot_see(const Hierarchy& hierarchy, std::uint32_t a, std::uint32_t b) {
  const Node& first = hierarchy.nodes[a];
  const Node& second = hierarchy.nodes[b];
  return looks_away(hierarchy, first, second) || looks_away(hierarchy, second, first);
}

Link evaluate_link(const World& world, const Hierarchy& hierarchy, std::uint32_t receiver, std::uint32_t sender,
                   std::uint32_t parts, std::uint32_t samples, std::uint64_t seed, const LinkOracle& oracle) {
  const Node& to = hierarchy.nodes[receiver];
  const Node& from = hierarchy.nodes[sender];
  const float typical = typical_kernel(to, from);
  const std::uint64_t key = combine(seed, kLinkKey, receiver, sender);
  Link link;
  link.receiver = receiver;
  link.sender = sender;
  link.evaluated = parts;
  if ((parts & kEmittedPart) != 0) {
    const Lines lines = draw_lines(world, hierarchy, to, from, SampleBy::kEmittedPower, samples, combine(key, 2));
    link.emitted = transport(lines, needs_direction(to, from));
    link.emitted_error = lines.error(oracle, to.area, typical);
    merge_geometry(lines, link);
  }
  if ((parts & kReflectedPart) != 0) {  // last: the direction is of reflected light where there is any
    const Lines lines = draw_lines(world, hierarchy, to, from, SampleBy::kReflectedPower, samples, combine(key, 1));
    link.reflected = transport(lines, needs_direction(to, from));
    link.reflected_error = lines.error(oracle, to.area, typical);
    merge_geometry(lines, link);
  }
  return link;
}

Link evaluate_source(const World& world, const Hierarchy& hierarchy, std::uint32_t receiver, std::uint32_t source,
                     std::uint32_t samples, std::uint64_t seed, const LinkOracle& oracle) {
  const Node& to = hierarchy.nodes[receiver];
  const std::uint64_t key = combine(seed, kLinkKey, receiver, source, 3);
  Lines lines;
  for (std::uint32_t i = 0; i < std::min(samples, kMaxSamples); ++i) {
    const NodeSample x = sample_node(hierarchy, to, SampleBy::kArea,
                                     static_cast<double>(sobol_owen_1d(i, combine(key, 1))),
                                     sobol_owen_2d(i, combine(key, 2)));
    if (source < world.emitters.punctual.size()) {
      const PunctualArrival arrival = arrive(world.emitters.punctual[source], x.position, world.radius);
      const float cosine = dot(x.normal, arrival.direction);
      add_line(world, lines, luminance(arrival.irradiance) * std::max(0.0F, cosine), cosine, x.leave(), arrival.target);
    } else {
      add_sky_lines(world, source == world.emitters.punctual.size(), x, combine(key, 4), lines);
    }
  }
  Link link;
  link.receiver = receiver;
  link.sender = source_sender(source);
  link.evaluated = kEmittedPart;
  link.emitted = transport(lines, to.is_cluster());
  link.emitted_error = lines.error(oracle, to.area, 0);
  merge_geometry(lines, link);
  return link;
}

}  // namespace radfarm
