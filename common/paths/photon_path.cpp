#include "paths/photon_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "scene/emission_sampling.h"

namespace radfarm {
namespace {

// 1 would let a path go on without end where nothing absorbs.
constexpr float kMaxSurvival = 0.9999F;
// What is a surface's least probable part to be chosen, as a share: an albedo is a mean, and may be dark towards one
// side.
constexpr float kLeastChoice = 0.05F;

/// The random numbers of one bounce of one path.
struct BounceSampler {
  std::uint64_t key;
  std::uint32_t index;

  BounceSampler(std::uint64_t path_key, std::uint64_t path, std::uint32_t bounce)
      : key(combine(path_key, path >> 32, bounce)), index(static_cast<std::uint32_t>(path)) {}
  float one(std::uint64_t use) const { return sobol_owen_1d(index, combine(key, use)); }
  Vec2 two(std::uint64_t use) const { return sobol_owen_2d(index, combine(key, use)); }
  std::uint64_t bits(std::uint64_t use) const { return combine(key, use, index); }
};
enum Use : std::uint64_t { kEmitterChoice = 1, kPlace, kDirection, kCoverage, kPart, kLobe, kWay, kSurvival };

/// What a surface sends on: a direction, and of each unit of power that arrives, how much of it.
struct Scattered {
  Ray ray;
  Spectrum weight;
  Origin origin = Origin::kDiffuse;
  bool is_straight = false;  // through a pane
};

/// What bends light about shading normals conserves radiance; of light itself it must conserve power. [Veach 1997, 5.3]
float adjoint(const SurfacePoint& point, const Vec3& in, const Vec3& out) {
  const float up = std::fabs(dot(point.shading_normal, in) * dot(point.geometric_normal, out));
  const float down = std::fabs(dot(point.geometric_normal, in) * dot(point.shading_normal, out));
  return down > 0 ? up / down : 0;
}

/// A surface as one path meets it: `in` points back along the path.
struct Vertex {
  SurfacePoint point;
  Vec3 in;
  Spectrum straight{};  // what a pane passes on; black elsewhere
  Bsdf bsdf;            // the last: making it sets the others

  Vertex(const World& w, const Hit& hit, const Vec3& back)
      : point(w.surfaces.at(hit)), in(back), bsdf(scattering(w, hit)) {}

 private:
  Bsdf scattering(const World& w, const Hit& hit) {
    face(point, in);
    Bsdf made = bsdf_at(w.surfaces, point, in);
    if (w.surfaces.is_pane(w.scene.instances[hit.instance].mesh)) {
      straight = pane_passage(w.surfaces.matter(point), std::fabs(dot(point.geometric_normal, in)));
    }
    return made;
  }
};

Scattered scatter_diffuse(const Vertex& v, const BounceSampler& sampler) {
  const Vec3 local = sample_cosine_hemisphere(sampler.two(kWay));
  const Vec3 out = normalize(Frame(v.point.geometric_normal).to_world(local));
  // Evenly by the geometric cosine: what is left of adjoint() is the arriving side's share.
  const float below = dot(v.point.geometric_normal, v.in);
  const float bend = below > 0 ? std::max(0.0F, dot(v.point.shading_normal, v.in)) / below : 0;
  const float shape = dot(v.point.shading_normal, out) > 0 ? v.bsdf.diffuse_shape(out) : 0;
  return {{leave(v.point), out}, v.bsdf.diffuse_reflectance() * (bend * shape), Origin::kDiffuse};
}

Scattered scatter_specular(const Vertex& v, const BounceSampler& sampler) {
  const Bsdf::Sample sample = v.bsdf.sample_specular(sampler.one(kLobe), sampler.two(kWay));
  if (is_black(sample.weight)) return {};
  const bool agree =
      dot(v.point.shading_normal, sample.direction) * dot(v.point.geometric_normal, sample.direction) > 0;
  if (!agree) return {};
  return {{leave(v.point, sample.direction), sample.direction},
          sample.weight * adjoint(v.point, v.in, sample.direction),
          Origin::kSpecular};
}

Scattered go_straight(const Vertex& v) { return {{leave(v.point, -v.in), -v.in}, v.straight, Origin::kSpecular, true}; }

/// One of the parts that send light of this colour on, by what they send; its weight is divided by the probability.
Scattered scatter(const Vertex& v, const Spectrum& power, const BounceSampler& sampler) {
  std::array<float, 3> share{luminance(power * v.bsdf.diffuse_reflectance()),
                             v.bsdf.has_specular() ? luminance(power * v.bsdf.specular_albedo()) : 0,
                             luminance(power * v.straight)};
  const float total = share[0] + share[1] + share[2];
  if (!(total > 0)) return {};
  float sum = 0;
  for (float& s : share) sum += s = s > 0 ? std::max(s, kLeastChoice * total) : 0;
  const float choice = sampler.one(kPart) * sum;
  const std::size_t part = choice < share[0] ? 0 : (choice < share[0] + share[1] || !(share[2] > 0) ? 1 : 2);
  if (!(share[part] > 0)) return {};
  Scattered scattered =
      part == 0 ? scatter_diffuse(v, sampler) : (part == 1 ? scatter_specular(v, sampler) : go_straight(v));
  scattered.weight *= sum / share[part];
  return scattered;
}

class Follower {
 public:
  Follower(const World& world, const SeeSegment& see, std::uint64_t key, std::uint64_t index)
      : world_(world), see_(see), key_(key), index_(index) {}

  const PathLosses& losses() const { return losses_; }

  /// Shows the segment, and turns it into the next one. False: the path ends.
  bool step(Segment& segment) {
    const BounceSampler sampler(key_, index_, segment.bounce + 1);
    Ray onward = segment.ray;
    onward.origin = segment.ray.origin + segment.ray.direction * segment.begin;
    if (segment.begin > 0) onward.origin = through_;
    const auto hit = world_.caster.closest_with_panes(onward, sampler.bits(kCoverage));
    segment.end = hit ? segment.begin + hit->distance : std::numeric_limits<float>::infinity();
    segment.instance = hit ? hit->instance : kNone;
    segment.triangle = hit ? hit->triangle : kNone;
    if (!hit) {
      see_(segment);
      losses_.escaped += static_cast<double>(luminance(segment.power));
      return false;
    }
    const Vertex vertex(world_, *hit, -segment.ray.direction);
    segment.end_normal = vertex.point.geometric_normal;
    see_(segment);
    return leave_surface(vertex, *hit, sampler, segment);
  }

 private:
  bool leave_surface(const Vertex& vertex, const Hit& hit, const BounceSampler& sampler, Segment& segment) {
    const Spectrum arrived = segment.power * hit.weight * world_.surfaces.absorption(vertex.point, hit.distance);
    const double before = static_cast<double>(luminance(segment.power));
    const Scattered next = scatter(vertex, arrived, sampler);
    const Spectrum sent = arrived * next.weight;
    const float survive = before > 0 ? std::min(kMaxSurvival, luminance(sent) / static_cast<float>(before)) : 0;
    if (!(survive > 0) || sampler.one(kSurvival) >= survive) {
      losses_.absorbed += before;
      return false;
    }
    segment.power = sent / survive;
    ++segment.bounce;
    if (next.is_straight) {
      segment.begin = segment.end;
      through_ = next.ray.origin;
      return true;
    }
    const float side = dot(next.ray.direction, vertex.point.geometric_normal) < 0 ? -1.0F : 1.0F;
    segment.ray = next.ray;
    segment.begin = 0;
    segment.origin = next.origin;
    segment.plane = vertex.point.geometric_normal * side;
    return true;
  }

  const World& world_;
  const SeeSegment& see_;
  const std::uint64_t key_;
  const std::uint64_t index_;
  PathLosses losses_;
  Vec3 through_{0, 0, 0};  // where it left the last pane
};

}  // namespace

PathLosses follow_path(const World& world, std::uint64_t key, std::uint64_t index, const SeeSegment& see) {
  const BounceSampler sampler(key, index, 0);
  const EmittedRay emitted = sample_emission(world, static_cast<double>(sampler.one(kEmitterChoice)),
                                             sampler.two(kPlace), sampler.two(kDirection));
  Segment segment;
  segment.ray = emitted.ray;
  segment.power = emitted.power;
  segment.plane = emitted.plane;
  Follower follower(world, see, key, index);
  if (!(luminance(segment.power) > 0)) return {};
  while (follower.step(segment)) {
  }
  return follower.losses();
}

}  // namespace radfarm
