#pragma once

#include <optional>

#include "math/vec.h"
#include "scene/scene.h"

namespace radfarm {

/// The open side of a room, such as the front of a Cornell box.
struct Opening {
  Vec3d centre{0, 0, 0};    // of the opening, in the world
  Vec3d outwards{0, 0, 1};  // unit, along an axis
  double half_width = 0;    // m
  double half_height = 0;
};

/// The side of a room through which to look in: of the box around the triangles whose centroids lie in `bulk`, the
/// upright face in which there is almost no surface that faces the room, while the opposite one is mostly closed. The
/// emptiest when there are several; none when all sides are closed or only the top is open. Cost: O(triangles).
std::optional<Opening> find_opening(const Scene& scene, const Imath::Box3d& bulk);

}  // namespace radfarm
