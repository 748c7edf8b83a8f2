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

  /// The nearest surface along a unit ray, up to `reach`. A surface lets the ray on with the probability passage(), decided by
  /// `key` and the triangle, so the answer does not depend on the order in which triangles are tested. Hit::weight, or
  /// `passed` where nothing is met, is the ray's colour after the panes it went through.
  std::optional<Hit> closest(const Ray& ray, std::uint64_t key, float reach = std::numeric_limits<float>::infinity(),
                             Spectrum* passed = nullptr) const;

  /// The nearest surface, panes too: for a caller that follows both what passes a pane and what it reflects.
  std::optional<Hit> closest_with_panes(const Ray& ray, std::uint64_t key) const;

  /// The share of light that passes from one point to another: 0 when blocked, else the product of passage().
  /// Both ends must already be off the surfaces they belong to (leave()).
  Spectrum transmittance(const Vec3& from, const Vec3& to) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Name and version of the ray caster underneath and its instruction set, for doctor and reports.
std::string ray_caster_name();

}  // namespace radfarm
