#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/vec.h"

namespace radfarm {

// Every sample_x maps u in [0, 1)^2 to a point; pdf_x is its density in the measure that the comment states.
// tests/statistical/sampling_test.cpp holds each pair to it. Local directions have z along the normal.

/// Concentric map of the unit disk, area-preserving. [Shirley and Chiu 1997]
Vec2 sample_uniform_disk(const Vec2& u);
/// Per unit area of the disk's plane.
inline float pdf_uniform_disk(const Vec2& point) { return point.length2() <= 1.0F ? kInversePi : 0.0F; }

Vec3 sample_cosine_hemisphere(const Vec2& u);
/// Per steradian.
inline float pdf_cosine_hemisphere(const Vec3& direction) { return std::fmax(0.0F, direction.z) * kInversePi; }

Vec3 sample_uniform_hemisphere(const Vec2& u);
/// Per steradian.
inline float pdf_uniform_hemisphere(const Vec3& direction) { return direction.z >= 0 ? 0.5F * kInversePi : 0.0F; }

Vec3 sample_uniform_sphere(const Vec2& u);
/// Per steradian.
inline float pdf_uniform_sphere() { return 0.25F * kInversePi; }

/// Barycentric coordinates of a point uniform over any triangle's area; they are >= 0 and add up to 1.
Vec3 sample_uniform_triangle(const Vec2& u);
/// Per m^2, of a triangle of `area` m^2.
inline float pdf_uniform_triangle(float area) { return 1.0F / area; }

/// Solid angle in steradians, in [0, 2 pi], of the triangle whose vertices lie at a, b and c from the observer. Accurate to
/// rounding of the inputs at any size. [Van Oosterom and Strackee 1983]
double triangle_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// Directions uniform over the solid angle of a triangle seen from a point. [Arvo 1995, as in pbrt-v4]
/// Not for solid angles outside [kMinSolidAngle, kMaxSolidAngle]: there, sample the area.
class SphericalTriangle {
 public:
  static constexpr double kMinSolidAngle = 3e-4;  // sr, pbrt-v4's limits
  static constexpr double kMaxSolidAngle = 6.22;
  struct Sample {
    Vec3 direction;     // unit, from the reference point
    Vec3 barycentrics;  // of the point of the triangle in that direction
  };

  SphericalTriangle(const Vec3d& v0, const Vec3d& v1, const Vec3d& v2, const Vec3d& reference);

  double solid_angle() const { return solid_angle_; }
  bool in_range() const { return solid_angle_ >= kMinSolidAngle && solid_angle_ <= kMaxSolidAngle; }
  /// Requires: in_range().
  Sample sample(const Vec2& u) const;
  /// Per steradian; the same in every direction inside.
  float pdf() const { return static_cast<float>(1.0 / solid_angle_); }

 private:
  Vec3d a_, b_;                  // unit vectors to v0 and v1
  Vec3d c_perpendicular_;        // the unit part of the vector to v2 that is perpendicular to a
  Vec3d opposite_[3];            // p1 x p2, p2 x p0, p0 x p1: volumes with a direction are its barycentrics
  double cos_ab_ = 1;
  double cos_alpha_ = 1;         // alpha: dihedral angle at a
  double sin_alpha_ = 0;
  double solid_angle_ = 0;
};

/// Chooses an index with probability proportional to its weight.
class DiscreteDistribution {
 public:
  struct Choice {
    std::size_t index;
    double probability;
  };

  DiscreteDistribution() = default;
  /// Requires: weights finite and >= 0.
  explicit DiscreteDistribution(std::span<const double> weights);

  std::size_t size() const { return cumulative_.size(); }
  double total() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }
  /// The index for u in [0, 1); never one of weight 0. {0, 0} when all weights are 0 or there are none. O(log size).
  Choice sample(double u) const;
  /// Discrete; 0 for all when the weights are all 0.
  double probability(std::size_t index) const;

 private:
  std::vector<double> cumulative_;  // weights summed up to and with each index
};

}  // namespace radfarm
