#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "base/status.h"
#include "scene/camera.h"
#include "scene/surface.h"

namespace radfarm {

/// Rays against a scene's triangles, by Embree: MEDIUM build quality, one fixed instruction set, so that the same rays give
/// the same bits on every machine of one numeric class. The only file that knows Embree. Thread-safe.
class RayCaster {
 public:
  /// Builds the acceleration structure; borrows `surfaces`. Meshes used once are placed in the top level, meshes used
  /// more often are instanced. O(n log n): about 0.5 s for a million triangles on one core.
  explicit RayCaster(const Surfaces& surfaces);
  RayCaster(RayCaster&&) noexcept;
  ~RayCaster();

  /// The nearest surface along a unit ray, up to `reach`. A surface with coverage a stops the ray with probability a, decided by
  /// `key` and the triangle, so the answer does not depend on the order in which triangles are tested.
  std::optional<Hit> closest(const Ray& ray, std::uint64_t key, float reach = std::numeric_limits<float>::infinity()) const;

  /// The share of light that passes from one point to another: 0 when blocked, else the product of (1 - coverage).
  /// Both ends must already be off the surfaces they belong to (leave()).
  float transmittance(const Vec3& from, const Vec3& to) const;

  /// transmittance() from one point to up to 8 targets as one packet. The same bits as 8 single calls are not promised:
  /// a caller uses one form or the other for all workers (DESIGN 6: one fixed packet width).
  void transmittance8(const Vec3& from, std::span<const Vec3> to, std::span<float> result) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Name and version of the ray caster underneath and its instruction set, for doctor and reports.
std::string ray_caster_name();

}  // namespace radfarm
