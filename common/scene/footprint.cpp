#include "scene/footprint.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

// Beyond this slant a look-up cuts the footprint anyway (texture_pyramid.cpp).
constexpr float kLeastCosine = 1.0F / 64;

}  // namespace

SurfaceFootprint cone_on_plane(const Vec3& normal, const Vec3& direction, float width) {
  const float cosine = dot(normal, direction);
  // Along the plane, the way the ray goes; straight down any way is as good.
  Vec3 along = normalize(direction - normal * cosine);
  if (along == Vec3(0, 0, 0)) along = Frame(normal).tangent;
  return {along * (width / std::max(std::fabs(cosine), kLeastCosine)), cross(normal, along) * width};
}

UvFootprint to_uv(const SurfaceFootprint& footprint, const std::array<Vec3, 3>& corners, const std::array<Vec2, 3>& uv) {
  // Tiny triangles can have an area below the smallest float square.
  const Vec3d e1 = to_double(corners[1]) - to_double(corners[0]), e2 = to_double(corners[2]) - to_double(corners[0]);
  const Vec3d normal = cross(e1, e2);
  const double squared = dot(normal, normal);
  if (!(squared > 0)) return {};
  const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  const auto in_uv = [&](const Vec3& v) {
    const Vec3d d = to_double(v);
    const auto s = static_cast<float>(dot(cross(d, e2), normal) / squared), t = static_cast<float>(dot(cross(e1, d), normal) / squared);
    return a * s + b * t;
  };
  return {in_uv(footprint.along), in_uv(footprint.across)};
}

}  // namespace radfarm
