#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/camera.h"

namespace radfarm {

/// A flat disc in space.
struct OrientedDisc {
  Vec3 centre;
  Vec3 normal;       // unit
  float radius = 0;  // m, > 0
};

/// All discs that a piece of a ray crosses. Knows Embree, as RayCaster does. Thread-safe.
class DiscCaster {
 public:
  /// O(n log n): about .1 s for 50,000 discs on one core; 100 to 200 bytes a disc.
  explicit DiscCaster(std::span<const OrientedDisc> discs);
  DiscCaster(DiscCaster&&) noexcept;
  ~DiscCaster();

  /// Who is told of a disc, by its index.
  using Visit = void (*)(void* user, std::uint32_t disc);

  /// Calls visit(user, disc) once for each disc that the ray crosses between the distances, from either side: all that
  /// it does cross, and some that it misses by rounding, so that whoever counts tests them again in double. In an order
  /// that depends on the discs alone. O(log n + crossings), 3 us at 7 of them among 50,000.
  void crossed(const Ray& ray, float near, float far, Visit visit, void* user) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace radfarm
