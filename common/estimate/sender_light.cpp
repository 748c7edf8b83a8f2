#include "estimate/sender_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimate/lit_reflector.h"
#include "math/polygon_irradiance.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

// Points of a sender from which a line's end is drawn by what they give.
constexpr std::uint32_t kCandidates = 2;
constexpr std::uint32_t kEmitterCandidates = 8;  // the edges of their shadows show
// What lines need beyond their own dimensions is as far off.
constexpr std::uint32_t kRelitDimension = 1U << 24;
// A patch with a larger form factor is drawn by solid angle.
constexpr float kNearFormFactor = 2e-3F;

/// Emission at the sampled point against the patch's mean: 1 for plain emitters.
Spectrum emission_ratio(const GatherPoint& point, const SenderNode& node, const SenderSample& y) {
  const SenderPatch& patch = point.context.tree.patches[y.patch];
  if (patch.is_textured_emitter == 0 || node.patch == kNone) return Spectrum(1.0F);
  const World& world = point.context.world;
  // The patch may be a part of its triangle: go by position.
  SurfacePoint at = world.surfaces.at(world.surfaces.hit_at(patch.instance, patch.triangle, y.position));
  face(at, patch.normal);
  const Spectrum here = world.emission(at);
  const Spectrum mean = node.emitted_power / (kPi * node.area);
  return {mean.r > 0 ? here.r / mean.r : 0, mean.g > 0 ? here.g / mean.g : 0, mean.b > 0 ? here.b / mean.b : 0};
}

/// What lines to a sender bring, times what the receiver's layers let through: its visible share by colour, and the product of that with the emission's texture.
struct Visible {
  Spectrum share;        // mean of V
  Spectrum textured;     // mean of V x emission ratio
  Spectrum relit;        // mean of V x reflected_ratio()
};

/// A point of the sender and the weight, up to a common factor, with which it stands for what the receiver gets.
struct Line {
  SenderSample target;
  float weight = 0;
};

/// Points of a patch that fills much of the view are drawn by solid angle: evenly by area, hardly any would fall on the near
/// part that gives most of the light, and visibility would be that of the far part.
Line draw_by_solid_angle(const GatherPoint& point, const SenderNode& node, const SphericalTriangle& triangle, const Vec2& u) {
  const SenderPatch& patch = point.context.tree.patches[node.patch];
  const SphericalTriangle::Sample sample = triangle.sample(u);
  const Vec3& b = sample.barycentrics;
  const Vec3 position = patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z;
  return {{position, patch.normal, patch.offset, node.patch, b.y, b.z},
          dot(point.surface.shading_normal, sample.direction)};
}

/// Points of a cluster, or of a patch far away, by what they send: the weight is the kernel, 1/m^2.
Line draw_by_power(const GatherPoint& point, std::uint32_t sender, float choice, const Vec2& u) {
  const SenderTree& tree = point.context.tree;
  Line line{sample_sender(tree, sender, choice, u), 0};
  const Vec3 offset = line.target.position - point.surface.position;
  const float squared = dot(offset, offset);
  const float cosine_x = dot(point.surface.shading_normal, offset), cosine_y = -dot(line.target.normal, offset);
  if (!(cosine_x > 0 && cosine_y > 0)) return line;
  line.weight = std::min(cosine_x * cosine_y / (kPi * squared * squared), 1 / tree.patches[line.target.patch].area);
  return line;
}

Spectrum visibility_of(const GatherPoint& point, const CriticalSender& sender, const SenderSample& y) {
  if (sender.resample_visibility == 0) return sender.visibility;
  const Vec3 offset = y.position - point.surface.position;
  if (!(dot(point.surface.geometric_normal, offset) > 0)) return {};
  const bool is_near = dot(offset, offset) < point.near_distance * point.near_distance;
  if (is_near && point.context.tree.patches[y.patch].emits == 0) return {};
  ++point.counters.visibility_rays;
  return point.context.world.caster.transmittance(point.start, y.leave());
}

/// The random numbers of one of a line's candidates: the first is stratified over the pixel's samples, and so are the others,
/// which are shifted copies of it (the R2 sequence).
Vec2 shifted(const Vec2& u, std::uint32_t candidate) {
  const auto wrap = [](float x) { return std::min(x - std::floor(x), 0x1.fffffep-1F); };
  const auto n = static_cast<float>(candidate);
  return {wrap(u.x + n * 0.7548776662F), wrap(u.y + n * 0.5698402910F)};
}

/// One of a few points of the sender, drawn by its weight, so that visibility is that of the parts that give most.
Line draw_line(const GatherPoint& point, const SenderNode& node, std::uint32_t node_id, const SphericalTriangle* near,
               std::uint32_t dimension) {
  const Vec2 u = point.sampler.two(dimension + 1);
  const float choice = point.sampler.one(dimension);
  float total = 0;
  Line drawn;
  float left = to_unit_float(point.sampler.key(dimension));
  const std::uint32_t candidates = is_black(node.emitted_power) ? kCandidates : kEmitterCandidates;
  for (std::uint32_t i = 0; i < candidates; ++i) {
    const Line line = near != nullptr ? draw_by_solid_angle(point, node, *near, shifted(u, i))
                                      : draw_by_power(point, node_id, shifted(Vec2(choice, 0), i).x, shifted(u, i));
    if (!(line.weight > 0)) continue;
    total += line.weight;
    // Reservoir: what is left of one random number decides again.
    const float share = line.weight / total;
    if (left < share) {
      drawn = line;
      left /= share;
    } else {
      left = (left - share) / (1 - share);
    }
  }
  return drawn;
}

/// Visibility of `node_id` by `count` lines. `form_factor` is the patch's, 0 for clusters.
Visible trace(const GatherPoint& point, const CriticalSender& sender, std::uint32_t node_id, float form_factor,
              std::uint32_t count, std::uint32_t dimension) {
  const SenderNode& node = point.context.tree.nodes[node_id];
  std::optional<SphericalTriangle> near;
  if (form_factor > kNearFormFactor) {
    const TriangleVertices& v = point.context.tree.patches[node.patch].vertices;
    near.emplace(to_double(v[0]), to_double(v[1]), to_double(v[2]), to_double(point.surface.position));
    if (!near->in_range()) near.reset();
  }
  float lines = 0;
  Spectrum passed, textured, relit;
  const bool reflects = !is_black(node.reflected_power);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Line line = draw_line(point, node, node_id, near ? &*near : nullptr, dimension + 2 * i);
    if (!(line.weight > 0)) continue;
    const Vec3 way = normalize(line.target.position - point.surface.position);
    const Spectrum visible = visibility_of(point, sender, line.target) * point.bsdf.diffuse_shape(way);
    ++lines;
    passed += visible;
    textured += emission_ratio(point, node, line.target) * visible;
    if (reflects && !is_black(visible)) relit += reflected_ratio(point, line.target, kRelitDimension + dimension + 2 * i) * visible;
  }
  // Every candidate fell below a horizon: they say nothing of the rest of the sender.
  if (!(lines > 0)) return {sender.visibility, sender.visibility, sender.visibility};
  return {passed / lines, textured / lines, relit / lines};
}

/// All light of one patch at the point: its exact form factor, its visibility by `count` lines. (gather.3)
Arrived from_patch(const GatherPoint& point, const CriticalSender& sender, std::uint32_t node_id, std::uint32_t count,
                   std::uint32_t dimension) {
  const SenderTree& tree = point.context.tree;
  const SenderNode& node = tree.nodes[node_id];
  const SenderPatch& patch = tree.patches[node.patch];
  if (dot(patch.normal, point.surface.position - patch.vertices[0]) <= 0) return {};
  const float form_factor =
      fast_polygon_form_factor(patch.vertices, point.surface.position, point.surface.shading_normal);
  ++point.counters.form_factor_samples;
  if (!(form_factor > 0)) return {};
  const float factor = form_factor / node.area;
  if (sender.resample_visibility == 0 && patch.is_textured_emitter == 0) {
    const Vec3 way = normalize(node.bounds.center() - point.surface.position);
    const Spectrum scale = sender.visibility * (factor * point.bsdf.diffuse_shape(way));
    return {node.emitted_power * scale, node.reflected_power * scale};
  }
  const Visible visible = trace(point, sender, node_id, form_factor, count, dimension);
  return {node.emitted_power * visible.textured * factor, node.reflected_power * (visible.relit * factor)};
}

}  // namespace

Arrived light_of_sender(const GatherPoint& point, const CriticalSender& sender, std::uint32_t count, std::uint32_t dimension) {
  const SenderTree& tree = point.context.tree;
  if (sender.resample_form_factor == 0) {
    const float cosine = cosine_to(point, sender.direction);
    if (cosine == 0) return {};
    const Visible visible = trace(point, sender, sender.node, 0, count, dimension);
    return {sender.direct * visible.textured * cosine, sender.indirect * (visible.relit * cosine)};
  }
  if (tree.nodes[sender.node].patch != kNone) return from_patch(point, sender, sender.node, count, dimension);
  // A cluster: as many of its patches as it has samples, each drawn for this point, each with one line.
  Arrived sum;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float choice = point.sampler.one(dimension + 2 * i);
    const DrawnPatch drawn =
        draw_patch(tree, sender.node, point.surface.position, point.surface.shading_normal, point.near_distance, choice);
    if (!(drawn.probability > 0)) continue;
    const Arrived one = from_patch(point, sender, drawn.node, 1, dimension + 2 * count + 2 * i);
    const float weight = 1 / (drawn.probability * static_cast<float>(count));
    sum.direct += one.direct * weight;
    sum.indirect += one.indirect * weight;
  }
  return sum;
}

}  // namespace radfarm
