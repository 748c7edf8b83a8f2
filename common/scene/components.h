#pragma once

#include <cstdint>
#include <vector>

#include "scene/surface.h"

namespace radfarm {

/// Of each vertex of a mesh, the first one at its position.
std::vector<std::uint32_t> join_by_position(const std::vector<Vec3>& positions);

/// Which triangles hang together: connected parts of meshes, their vertices joined by position.
class Components {
 public:
  /// O(triangles log triangles).
  explicit Components(const Scene& scene);

  /// The same number of two triangles exactly where they are of one instance and of one part of its mesh.
  std::uint64_t of(std::uint32_t instance, std::uint32_t triangle) const {
    return (std::uint64_t{instance} << 32) | parts_[mesh_of_[instance]][triangle];
  }

 private:
  std::vector<std::uint32_t> mesh_of_;             // one an instance
  std::vector<std::vector<std::uint32_t>> parts_;  // one a mesh, one a triangle: a vertex of the part
};

}  // namespace radfarm
