#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace radfarm {

/// Cuts a simple polygon, concave ones too, into n - 2 triangles of its corners, with its own orientation: by ear
/// clipping in the plane its area vector is normal to. A polygon that crosses itself or has no area is cut into a fan.
/// Cost: O(n) when convex, else O(n^2) usually. Requires: at least 3 corners.
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const Vec3d> corners);

}  // namespace radfarm
