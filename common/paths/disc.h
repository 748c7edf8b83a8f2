#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/components.h"
#include "scene/disc_caster.h"
#include "scene/world.h"

namespace radfarm {

/// Where irradiance is estimated: a disc on the tangent plane of a surface point, or around a point in mid-air.
/// docs/pipeline.md (paths.2), [3]
struct Disc {
  static constexpr std::uint64_t kInAir = ~std::uint64_t{0};
  OrientedDisc shape;                // the normal is the shading normal: light arrives against it
  Vec3 geometric_normal{0, 0, 1};    // of the surface, on the same side
  Vec3 start{0, 0, 0};               // the point off its surface
  std::uint64_t component = kInAir;  // Components::of
};

/// How far a disc reaches along its plane before something stands on it, as a share of its radius: one a sector. What
/// lies beyond is no part of it: paths there are not counted, and its area is what is left. So neither the far side of
/// a thin wall nor the inside of what stands on a floor count as dark floor. (paths.4)
constexpr std::size_t kSectors = 16;
using Reach = std::array<std::uint8_t, kSectors>;  // in 255ths
constexpr std::uint8_t kWhole = 255;

/// A disc at a point of a surface, as face()d. Requires: radius > 0.
Disc disc_at(const SurfacePoint& point, std::uint64_t component, float radius);
/// A disc in mid-air. Requires: unit normal.
Disc disc_in_air(const Vec3& point, const Vec3& normal, float radius);

/// Discs ready for paths, with what stands on them. Borrows `world`. Immutable: thread-safe.
class DiscSet {
 public:
  /// Casts kSectors rays a disc on all threads, about 10 us a disc.
  DiscSet(const World& world, const Components& components, std::vector<Disc> discs);

  std::span<const Disc> discs() const { return discs_; }
  const DiscCaster& caster() const { return caster_; }
  const Components& components() const { return components_; }
  /// Null: all of it is free.
  const Reach* reach(std::uint32_t disc) const { return cut_[disc] == kNone ? nullptr : &reaches_[cut_[disc]]; }
  float largest_radius() const { return largest_radius_; }

 private:
  const Components& components_;
  std::vector<Disc> discs_;
  std::vector<std::uint32_t> cut_;  // one a disc, into reaches_
  std::vector<Reach> reaches_;
  float largest_radius_ = 0;
  DiscCaster caster_;
};

/// How far the disc reaches in each sector.
Reach measure_reach(const World& world, const Disc& disc);

/// Whether a surface that faces a disc like this goes on with the disc's own, rather than standing on it: within 60
/// degrees.
inline bool continues(const Vec3& disc_normal, const Vec3& normal) { return dot(disc_normal, normal) > 0.5F; }

}  // namespace radfarm
