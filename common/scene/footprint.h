#pragma once

#include <array>

#include "math/vec.h"

namespace radfarm {

/// The part of a surface that a lookup stands for: a parallelogram about the point, in world space (m) ...
struct SurfaceFootprint {
  Vec3 along{0, 0, 0};
  Vec3 across{0, 0, 0};
};

/// ... and in a set of texture coordinates. The zero footprint is the point itself.
struct UvFootprint {
  Vec2 along{0, 0};
  Vec2 across{0, 0};
  bool is_point() const { return along == Vec2(0, 0) && across == Vec2(0, 0); }
};

/// Where a cone `width` wide about unit `direction` meets a plane: longer along the ray's slant, by 1 / cosine, at most 64.
/// [Akenine-Moller et al. 2021, Improved shader and texture level of detail using ray cones]
SurfaceFootprint cone_on_plane(const Vec3& normal, const Vec3& direction, float width);

/// The same in the texture coordinates of a triangle's corners. A triangle without area has none.
UvFootprint to_uv(const SurfaceFootprint& footprint, const std::array<Vec3, 3>& corners, const std::array<Vec2, 3>& uv);

/// The footprint under the linear part of a TextureUse::map.
inline UvFootprint moved(const UvFootprint& f, const std::array<float, 6>& m) {
  const auto move = [&](const Vec2& v) { return Vec2(m[0] * v.x + m[1] * v.y, m[3] * v.x + m[4] * v.y); };
  return {move(f.along), move(f.across)};
}

}  // namespace radfarm
