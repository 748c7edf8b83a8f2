#include "paths/disc.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kReachKey = 0x7265616368;  // "reach"
constexpr std::size_t kGrain = 256;
// A straight wall that two edges of a sector meet at one distance is nearer between them: cos(pi / kSectors).
constexpr float kStraightWall = 0.98F;

std::vector<OrientedDisc> shapes(std::span<const Disc> discs) {
  std::vector<OrientedDisc> all;
  all.reserve(discs.size());
  for (const Disc& disc : discs) all.push_back(disc.shape);
  return all;
}

/// The free share of the radius along the edge where sector k begins.
float free_along(const World& world, const Disc& disc, const Frame& frame, std::size_t k) {
  const float angle = 2 * kPi * static_cast<float>(k) / kSectors;
  const Vec3 way = normalize(frame.to_world({std::cos(angle), std::sin(angle), 0}));
  const auto hit = world.caster.closest({disc.start, way}, combine(kReachKey, k), disc.shape.radius);
  if (!hit) return 1;
  SurfacePoint met = world.surfaces.at(*hit);
  face(met, -way);
  return continues(disc.shape.normal, met.geometric_normal) ? 1 : hit->distance / disc.shape.radius;
}

}  // namespace

Disc disc_at(const SurfacePoint& point, std::uint64_t component, float radius) {
  return {{point.position, point.shading_normal, radius}, point.geometric_normal, leave(point), component};
}

Disc disc_in_air(const Vec3& point, const Vec3& normal, float radius) {
  return {{point, normal, radius}, normal, point, Disc::kInAir};
}

Reach measure_reach(const World& world, const Disc& disc) {
  std::array<float, kSectors> free{};
  const Frame frame(disc.shape.normal);
  for (std::size_t k = 0; k < kSectors; ++k) free[k] = free_along(world, disc, frame, k);
  Reach reach{};
  for (std::size_t k = 0; k < kSectors; ++k) {
    const float until = std::min(free[k], free[(k + 1) % kSectors]);
    reach[k] = until < 1 ? static_cast<std::uint8_t>(std::clamp(255 * kStraightWall * until, 1.0F, 254.0F)) : kWhole;
  }
  return reach;
}

DiscSet::DiscSet(const World& world, const Components& components, std::vector<Disc> discs)
    : components_(components), discs_(std::move(discs)), cut_(discs_.size(), kNone), caster_(shapes(discs_)) {
  std::vector<Reach> all(discs_.size());
  parallel_for(discs_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i] = measure_reach(world, discs_[i]);
  });
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    largest_radius_ = std::max(largest_radius_, discs_[i].shape.radius);
    if (std::all_of(all[i].begin(), all[i].end(), [](std::uint8_t share) { return share == kWhole; })) continue;
    cut_[i] = static_cast<std::uint32_t>(reaches_.size());
    reaches_.push_back(all[i]);
  }
}

}  // namespace radfarm
