#pragma once

#include <cmath>
#include <numbers>

#include <Imath/ImathBox.h>
#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

namespace radfarm {

/// Points, directions and transforms are Imath's. Its matrices act on row vectors: p' = p * M, and A * B applies A first.
using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec3d = Imath::V3d;
using Vec4 = Imath::V4f;
using Matrix4 = Imath::M44f;
using Matrix4d = Imath::M44d;
using Box3 = Imath::Box3f;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInversePi = std::numbers::inv_pi_v<float>;

inline float dot(const Vec3& a, const Vec3& b) { return a.dot(b); }
inline double dot(const Vec3d& a, const Vec3d& b) { return a.dot(b); }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) { return a.cross(b); }
inline float length(const Vec3& a) { return a.length(); }
inline double length(const Vec3d& a) { return a.length(); }
/// The unit vector; the zero vector stays zero.
inline Vec3 normalize(const Vec3& a) { return a.normalized(); }
inline Vec3d normalize(const Vec3d& a) { return a.normalized(); }
inline float max_abs_component(const Vec3& a) {
  return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z)));
}
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline Vec3d to_double(const Vec3& a) { return {a.x, a.y, a.z}; }
inline Vec3 to_float(const Vec3d& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Two unit vectors perpendicular to a unit normal and to each other; branch-free and continuous but at one pole.
/// [Duff et al. 2017, Building an Orthonormal Basis, Revisited]
struct Frame {
  Vec3 tangent;
  Vec3 bitangent;
  Vec3 normal;

  explicit Frame(const Vec3& n) : normal(n) {
    const float sign = std::copysign(1.0F, n.z);
    const float a = -1.0F / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = {1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3 to_world(const Vec3& local) const { return tangent * local.x + bitangent * local.y + normal * local.z; }
};

}  // namespace radfarm
