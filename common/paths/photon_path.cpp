#include "paths/photon_path.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "math/sobol.h"
#include "paths/light_scattering.h"
#include "scene/emission_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPathKey = 0x70686f746f6e;  // "photon"
// 1 would let a path go on without end where nothing absorbs.
constexpr float kMaxSurvival = 0.9999F;

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
    const LightVertex vertex(world_, *hit, -segment.ray.direction);
    segment.end_normal = vertex.point.geometric_normal;
    see_(segment);
    return leave_surface(vertex, *hit, sampler, segment);
  }

 private:
  bool leave_surface(const LightVertex& vertex, const Hit& hit, const BounceSampler& sampler, Segment& segment) {
    const Spectrum arrived = segment.power * hit.weight * world_.surfaces.absorption(vertex.point, hit.distance);
    const double before = static_cast<double>(luminance(segment.power));
    const ScatteredLight next =
        scatter_light(vertex, arrived, {sampler.one(kPart), sampler.one(kLobe), sampler.two(kWay)});
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
    const bool is_folded = world_.scene.materials[vertex.point.material].folds_specular;
    segment.leaves_specular = next.is_specular;
    segment.origin = next.is_specular && !is_folded ? Origin::kSpecular : Origin::kDiffuse;
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

PathLosses follow_batch(const World& world, const PathBatch& batch, const SeeSegment& see,
                        const std::function<void()>& end_path) {
  const std::uint64_t key = combine(batch.seed, kPathKey, batch.batch);
  PathLosses losses;
  for (std::uint64_t i = 0; i < batch.paths; ++i) {
    const PathLosses one = follow_path(world, key, i, see);
    end_path();
    losses.absorbed += one.absorbed;
    losses.escaped += one.escaped;
  }
  return losses;
}

}  // namespace radfarm
