#pragma once

#include <vector>

#include "scene/surface.h"

namespace radfarm {

/// Which triangles belong to a closed surface: to a connected part of a mesh, its vertices joined by position, of which every
/// edge has two triangles. A ray that meets such a part from outside leaves it again.
class ClosedComponents {
 public:
  /// O(triangles log triangles).
  explicit ClosedComponents(const Scene& scene);

  bool is_closed(const Hit& hit) const { return closed_[mesh_of_[hit.instance]][hit.triangle]; }

 private:
  std::vector<std::uint32_t> mesh_of_;      // one an instance
  std::vector<std::vector<bool>> closed_;   // one a mesh, one a triangle
};

}  // namespace radfarm
