#include "estimate/gather.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/polygon_irradiance.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kCoverageDimension = 1;
constexpr std::uint32_t kVertexDimension = 2;
constexpr std::uint32_t kChoiceDimension = 3;
constexpr std::uint32_t kPunctualDimension = 4;
constexpr std::uint32_t kFirstSenderDimension = 16;
// More punctual lights than this are sampled by their unoccluded irradiance at the point instead of all traced.
constexpr std::size_t kMaxTracedPunctual = 8;

// Lines that fall below a horizon are drawn again this often: the rest of the sender is what visibility is wanted of.
constexpr std::uint32_t kAttempts = 8;
// A patch with a larger form factor is drawn by solid angle.
constexpr float kNearFormFactor = 2e-3F;

/// Irradiance at the visible point, direct and indirect apart, lux.
struct Arrived {
  Spectrum direct;
  Spectrum indirect;
};

/// One visible point and all that its gather needs.
struct Point {
  const GatherContext& context;
  const SurfacePoint& surface;
  const PixelSampler& sampler;
  Counters& counters;
  Vec3 start{0, 0, 0};  // where rays leave it
};

float cosine_to(const Point& point, const Vec3& direction) {
  return std::max(0.0F, dot(point.surface.shading_normal, direction));
}

void add_lobes(const Point& point, const VertexSenders& senders, Arrived& arrived) {
  for (const Lobe& lobe : senders.lobes) {
    const float cosine = cosine_to(point, lobe.direction);
    arrived.direct += lobe.direct * cosine;
    arrived.indirect += lobe.indirect * cosine;
  }
}

/// Emission at the sampled point against the patch's mean: 1 for plain emitters.
Spectrum emission_ratio(const Point& point, const SenderNode& node, const SenderSample& y) {
  const SenderPatch& patch = point.context.tree.patches[y.patch];
  if (patch.is_textured_emitter == 0 || node.patch == kNone) return Spectrum(1.0F);
  const World& world = point.context.world;
  // The patch may be a part of its triangle: go by position.
  const TriangleVertices whole = world.surfaces.triangle(patch.instance, patch.triangle);
  const Vec3 e1 = whole[1] - whole[0], e2 = whole[2] - whole[0], d = y.position - whole[0];
  const Vec3 normal = cross(e1, e2);
  const float area = dot(normal, normal);
  float u = std::clamp(dot(cross(d, e2), normal) / area, 0.0F, 1.0F);
  float v = std::clamp(dot(cross(e1, d), normal) / area, 0.0F, 1.0F);
  if (world.surfaces.is_mirrored(patch.instance)) std::swap(u, v);
  SurfacePoint at = world.surfaces.at({patch.instance, patch.triangle, u, v, 0});
  face(at, patch.normal);
  const Spectrum here = world.surfaces.emission(at);
  const Spectrum mean = node.emitted_power / (kPi * node.area);
  return {mean.r > 0 ? here.r / mean.r : 0, mean.g > 0 ? here.g / mean.g : 0, mean.b > 0 ? here.b / mean.b : 0};
}

/// What lines to a sender bring: its visible share, and the product of that with the emission's texture.
struct Visible {
  float share = 0;       // sum w V / sum w
  Spectrum textured;     // sum w V ratio / sum w
};

/// A point of the sender and the weight, up to a common factor, with which it stands for what the receiver gets.
struct Line {
  SenderSample target;
  float weight = 0;
};

/// Points of a patch that fills much of the view are drawn by solid angle: evenly by area, hardly any would fall on the near
/// part that gives most of the light, and visibility would be that of the far part.
Line draw_by_solid_angle(const Point& point, const SenderNode& node, const SphericalTriangle& triangle, const Vec2& u) {
  const SenderPatch& patch = point.context.tree.patches[node.patch];
  const SphericalTriangle::Sample sample = triangle.sample(u);
  const Vec3& b = sample.barycentrics;
  const Vec3 position = patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z;
  return {{position, patch.normal, patch.offset, node.patch, b.y, b.z},
          dot(point.surface.shading_normal, sample.direction)};
}

/// Points of a cluster, or of a patch far away, by what they send: the weight is the kernel, 1/m^2.
Line draw_by_power(const Point& point, std::uint32_t sender, float choice, const Vec2& u) {
  const SenderTree& tree = point.context.tree;
  Line line{sample_sender(tree, sender, choice, u), 0};
  const Vec3 offset = line.target.position - point.surface.position;
  const float squared = dot(offset, offset);
  const float cosine_x = dot(point.surface.shading_normal, offset), cosine_y = -dot(line.target.normal, offset);
  if (!(cosine_x > 0 && cosine_y > 0)) return line;
  line.weight = std::min(cosine_x * cosine_y / (kPi * squared * squared), 1 / tree.patches[line.target.patch].area);
  return line;
}

float visibility_of(const Point& point, const CriticalSender& sender, const SenderSample& y) {
  if (sender.resample_visibility == 0) return sender.visibility;
  if (!(dot(point.surface.geometric_normal, y.position - point.surface.position) > 0)) return 0;
  ++point.counters.visibility_rays;
  return point.context.world.caster.transmittance(point.start, y.leave());
}

/// Random numbers of the first attempt are stratified over the pixel's samples, those of further ones are not.
Vec2 draw_again(const Point& point, std::uint32_t dimension, std::uint32_t attempt) {
  if (attempt == 0) return point.sampler.two(dimension);
  const std::uint64_t key = combine(point.sampler.key(dimension), attempt);
  return {to_unit_float(combine(key, 1)), to_unit_float(combine(key, 2))};
}

/// Visibility of `node` by `count` lines. `form_factor` is the patch's, 0 for clusters.
Visible trace(const Point& point, const CriticalSender& sender, std::uint32_t node_id, float form_factor,
              std::uint32_t count, std::uint32_t dimension) {
  const SenderNode& node = point.context.tree.nodes[node_id];
  std::optional<SphericalTriangle> near;
  if (form_factor > kNearFormFactor) {
    const TriangleVertices& v = point.context.tree.patches[node.patch].vertices;
    near.emplace(to_double(v[0]), to_double(v[1]), to_double(v[2]), to_double(point.surface.position));
    if (!near->in_range()) near.reset();
  }
  float weights = 0, passed = 0;
  Spectrum textured;
  for (std::uint32_t i = 0; i < count; ++i) {
    Line line;
    for (std::uint32_t attempt = 0; attempt < kAttempts && !(line.weight > 0); ++attempt) {
      const Vec2 u = draw_again(point, dimension + 2 * i + 1, attempt);
      line = near ? draw_by_solid_angle(point, node, *near, u)
                  : draw_by_power(point, node_id, draw_again(point, dimension + 2 * i, attempt).x, u);
    }
    if (!(line.weight > 0)) continue;
    const float visible = visibility_of(point, sender, line.target);
    weights += line.weight;
    passed += line.weight * visible;
    textured += emission_ratio(point, node, line.target) * (line.weight * visible);
  }
  // Every line fell below a horizon: they say nothing of the rest of the sender.
  if (!(weights > 0)) return {sender.visibility, Spectrum(sender.visibility)};
  return {passed / weights, textured / weights};
}

/// All light of one patch at the point: its exact form factor, its visibility by `count` lines. (gather.3)
Arrived from_patch(const Point& point, const CriticalSender& sender, std::uint32_t node_id, std::uint32_t count,
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
    const float scale = factor * sender.visibility;
    return {node.emitted_power * scale, node.reflected_power * scale};
  }
  const Visible visible = trace(point, sender, node_id, form_factor, count, dimension);
  return {node.emitted_power * visible.textured * factor, node.reflected_power * (visible.share * factor)};
}

/// All light of one critical sender at the point, visibility included.
Arrived resample(const Point& point, const CriticalSender& sender, std::uint32_t count, std::uint32_t dimension) {
  const SenderTree& tree = point.context.tree;
  if (sender.resample_form_factor == 0) {
    const float cosine = cosine_to(point, sender.direction);
    if (cosine == 0) return {};
    const Visible visible = trace(point, sender, sender.node, 0, count, dimension);
    return {sender.direct * visible.textured * cosine, sender.indirect * (visible.share * cosine)};
  }
  if (tree.nodes[sender.node].patch != kNone) return from_patch(point, sender, sender.node, count, dimension);
  // A cluster: as many of its patches as it has samples, each drawn for this point, each with one line.
  Arrived sum;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float choice = point.sampler.one(dimension + 2 * i);
    const DrawnPatch drawn =
        draw_patch(tree, sender.node, point.surface.position, point.surface.shading_normal, choice);
    if (!(drawn.probability > 0)) continue;
    const Arrived one = from_patch(point, sender, drawn.node, 1, dimension + 2 * count + 2 * i);
    const float weight = 1 / (drawn.probability * static_cast<float>(count));
    sum.direct += one.direct * weight;
    sum.indirect += one.indirect * weight;
  }
  return sum;
}

/// (gather.2) Draws senders by systematic sampling in proportion to what each is likely to give this very point: N positions,
/// one step apart from a random start, fall on senders laid end to end by their weights; sender s is taken floor or ceil of
/// N w_s times, N w_s on average.
void add_critical(const Point& point, const VertexSenders& senders, Arrived& arrived) {
  thread_local std::vector<float> until;  // scratch: weights added up to and with each sender
  until.resize(senders.critical.size());
  float total = 0;
  for (std::size_t i = 0; i < until.size(); ++i) {
    const CriticalSender& sender = senders.critical[i];
    total += sender.prior * likely_irradiance(sender.outline, point.surface.position, point.surface.shading_normal);
    until[i] = total;
  }
  if (!(total > 0)) return;
  const float step = total / point.context.settings.samples_per_gather;
  std::uint32_t dimension = kFirstSenderDimension;
  for (float position = point.sampler.one(kChoiceDimension) * step; position < total;) {
    const auto end = std::upper_bound(until.begin(), until.end(), position);
    if (end == until.end()) return;
    const auto i = static_cast<std::size_t>(end - until.begin());
    std::uint32_t count = 0;
    for (; position < until[i]; position += step) ++count;
    const Arrived one = resample(point, senders.critical[i], count, dimension);
    const float expected = (until[i] - (i > 0 ? until[i - 1] : 0)) / step;
    const float weight = static_cast<float>(count) / expected;
    arrived.direct += one.direct * weight;
    arrived.indirect += one.indirect * weight;
    dimension += 4 * count;
  }
}

void add_punctual_light(const Point& point, const PunctualLight& light, float weight, Arrived& arrived) {
  const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
  const float cosine = cosine_to(point, arrival.direction);
  if (cosine == 0 || !(dot(point.surface.geometric_normal, arrival.direction) > 0)) return;
  if (is_black(arrival.irradiance)) return;
  ++point.counters.visibility_rays;
  const float visible = point.context.world.caster.transmittance(point.start, arrival.target);
  arrived.direct += arrival.irradiance * (cosine * visible * weight);
}

void add_punctual(const Point& point, Arrived& arrived) {
  const std::vector<PunctualLight>& lights = point.context.world.emitters.punctual;
  if (lights.size() <= kMaxTracedPunctual) {
    for (const PunctualLight& light : lights) add_punctual_light(point, light, 1, arrived);
    return;
  }
  std::vector<double> weights;
  for (const PunctualLight& light : lights) {
    const PunctualArrival arrival = arrive(light, point.surface.position, point.context.world.radius);
    weights.push_back(static_cast<double>(luminance(arrival.irradiance) * cosine_to(point, arrival.direction)));
  }
  const DiscreteDistribution choice(weights);
  if (!(choice.total() > 0)) return;
  for (std::uint32_t i = 0; i < kMaxTracedPunctual; ++i) {
    const float u = (static_cast<float>(i) + point.sampler.one(kPunctualDimension)) / kMaxTracedPunctual;
    const auto chosen = choice.sample(static_cast<double>(u));
    const auto weight = static_cast<float>(1 / (chosen.probability * kMaxTracedPunctual));
    add_punctual_light(point, lights[chosen.index], weight, arrived);
  }
}

}  // namespace

RadianceParts gather_radiance(const GatherContext& context, const Ray& ray, const PixelSampler& sampler,
                              Counters& counters) {
  RadianceParts parts;
  ++counters.camera_rays;
  const auto hit = context.world.caster.closest(ray, sampler.key(kCoverageDimension));
  if (!hit) return parts;
  SurfacePoint surface = context.world.surfaces.at(*hit);
  face(surface, -ray.direction);
  parts.emission = context.world.surfaces.emission(surface);
  const Spectrum rho = context.world.surfaces.reflectance(surface);
  if (is_black(rho)) return parts;

  const Point point{context, surface, sampler, counters, leave(surface)};
  Arrived arrived;
  add_punctual(point, arrived);
  if (!context.tree.nodes.empty()) {
    const Interpolation at = interpolate(context.senders.grid(), surface.position);
    const VertexSenders& senders = context.senders.at(choose_vertex(at, sampler.one(kVertexDimension)));
    add_lobes(point, senders, arrived);
    add_critical(point, senders, arrived);
  }
  parts.direct = rho * arrived.direct * kInversePi;
  if (context.has_interreflection) parts.indirect = rho * arrived.indirect * kInversePi;
  return parts;
}

}  // namespace radfarm
