#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "scene/world.h"

namespace radfarm {

/// A triangle side by number: 2 x (triangle's number over all instances, in order) + (0 front, 1 back).
struct SideNumbers {
  explicit SideNumbers(const Scene& scene);
  std::uint32_t of(std::uint32_t instance, std::uint32_t triangle, bool is_front) const {
    return 2 * (first_triangle[instance] + triangle) + (is_front ? 0 : 1);
  }
  std::vector<std::uint32_t> first_triangle;  // one an instance
  std::uint32_t count = 0;
};

/// Which triangle sides light can reach at all: one flag a side.
///
/// A few cosine-distributed rays from every side join it with the sides they meet; what hangs together with an emitting side,
/// a punctual light or a side that specular paths light is reached.
/// The inside of closed furniture and the outside of a closed room are not: without this,
/// clusters would spread light to faces that turn the right way but lie inside (docs/pipeline.md, radiosity.2).
/// A ray a side, more from large ones, and up to 4 from sides that these leave dark; about 1 us each. Deterministic.
/// `specular`: specular_irradiance() of the sides, or nothing.
std::vector<bool> reachable_sides(const World& world, const SideNumbers& sides, std::uint64_t seed, const Progress& progress = {},
                                  std::span<const Spectrum> specular = {});

}  // namespace radfarm
