#include "math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace radfarm {
namespace {

double safe_sqrt(double x) { return std::sqrt(std::max(0.0, x)); }

/// The unit vector along the part of v that is perpendicular to the unit vector w.
Vec3d perpendicular_part(const Vec3d& v, const Vec3d& w) { return normalize(v - w * dot(v, w)); }

}  // namespace

Vec2 sample_uniform_disk(const Vec2& u) {
  const float x = 2 * u.x - 1;
  const float y = 2 * u.y - 1;
  if (x == 0 && y == 0) return {0, 0};
  const bool wide = std::fabs(x) > std::fabs(y);
  const float radius = wide ? x : y;
  const float angle = wide ? kPi / 4 * (y / x) : kPi / 2 - kPi / 4 * (x / y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = sample_uniform_disk(u);
  return {d.x, d.y, std::sqrt(std::fmax(0.0F, 1 - d.x * d.x - d.y * d.y))};
}

Vec3 sample_uniform_hemisphere(const Vec2& u) {
  const float radius = std::sqrt(std::fmax(0.0F, 1 - u.x * u.x));
  const float phi = 2 * kPi * u.y;
  return {radius * std::cos(phi), radius * std::sin(phi), u.x};
}

Vec3 sample_uniform_sphere(const Vec2& u) {
  const float z = 1 - 2 * u.x;
  const float radius = 2 * std::sqrt(std::fmax(0.0F, u.x * (1 - u.x)));  // sqrt(1 - z^2) without cancellation
  const float phi = 2 * kPi * u.y;
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

Vec3 sample_uniform_triangle(const Vec2& u) {
  // Fold the unit square about its diagonal without tearing strata apart. [Heitz 2019]
  const float b0 = u.x < u.y ? u.x / 2 : u.x - u.y / 2;
  const float b1 = u.x < u.y ? u.y - u.x / 2 : u.y / 2;
  return {b0, b1, std::fmax(0.0F, 1 - b0 - b1)};
}

double triangle_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = length(a);
  const double lb = length(b);
  const double lc = length(c);
  // The triple product from edges: they cancel exactly where a.(b x c) would lose a small or far triangle.
  const double volume = std::fabs(dot(a, cross(b - a, c - a)));
  const double scale = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  if (volume == 0 && scale == 0) return 0;  // the observer is a vertex
  return 2 * std::atan2(volume, scale);
}

SphericalTriangle::SphericalTriangle(const Vec3d& v0, const Vec3d& v1, const Vec3d& v2, const Vec3d& reference) {
  const Vec3d p0 = v0 - reference;
  const Vec3d p1 = v1 - reference;
  const Vec3d p2 = v2 - reference;
  solid_angle_ = triangle_solid_angle(p0, p1, p2);
  opposite_[0] = cross(p1, p2);
  opposite_[1] = cross(p2, p0);
  opposite_[2] = cross(p0, p1);
  a_ = normalize(p0);
  b_ = normalize(p1);
  const Vec3d c = normalize(p2);
  c_perpendicular_ = perpendicular_part(c, a_);
  cos_ab_ = std::clamp(dot(a_, b_), -1.0, 1.0);

  // alpha is the angle between the parts of b and c perpendicular to a.
  const Vec3d b_perpendicular = perpendicular_part(b_, a_);
  cos_alpha_ = std::clamp(dot(b_perpendicular, c_perpendicular_), -1.0, 1.0);
  sin_alpha_ = length(cross(b_perpendicular, c_perpendicular_));
}

SphericalTriangle::Sample SphericalTriangle::sample(const Vec2& u) const {
  // The sub-triangle (a, b, c') of area u.x: c' lies on the arc from a to c, where its angle beta' at b obeys
  // alpha + beta' + gamma' = pi + area.
  const double area = static_cast<double>(u.x) * solid_angle_;
  const double sin_area = -std::sin(area);  // of pi + area
  const double cos_area = -std::cos(area);
  const double sin_phi = sin_area * cos_alpha_ - cos_area * sin_alpha_;
  const double cos_phi = cos_area * cos_alpha_ + sin_area * sin_alpha_;
  const double k1 = cos_phi + cos_alpha_;
  const double k2 = sin_phi - sin_alpha_ * cos_ab_;
  const double denominator = (k2 * sin_phi + k1 * cos_phi) * sin_alpha_;
  const double ratio = denominator == 0 ? 1 : (k2 + (k2 * cos_phi - k1 * sin_phi) * cos_alpha_) / denominator;
  const double cos_side = std::clamp(ratio, -1.0, 1.0);
  const Vec3d c = a_ * cos_side + c_perpendicular_ * safe_sqrt(1 - cos_side * cos_side);

  // A point of the arc from b to c', uniform in its cosine.
  const double cos_theta = 1 - static_cast<double>(u.y) * (1 - dot(c, b_));
  const Vec3d direction = b_ * cos_theta + perpendicular_part(c, b_) * safe_sqrt(1 - cos_theta * cos_theta);

  // Its barycentrics in the plane, with rounding kept inside the triangle.
  const double sign = dot(direction, opposite_[0]) + dot(direction, opposite_[1]) + dot(direction, opposite_[2]);
  Vec3d weights;
  for (int i = 0; i < 3; ++i) weights[i] = std::max(0.0, dot(direction, opposite_[i]) / sign);
  return {to_float(direction), to_float(weights / (weights.x + weights.y + weights.z))};
}

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights) {
  cumulative_.reserve(weights.size());
  double sum = 0;
  for (const double weight : weights) {
    RADFARM_CHECK(std::isfinite(weight) && weight >= 0);
    sum += weight;
    cumulative_.push_back(sum);
  }
}

DiscreteDistribution::Choice DiscreteDistribution::sample(double u) const {
  if (total() <= 0) return {0, 0.0};
  // The first sum above the target belongs to a positive weight, since a zero weight repeats the sum before it.
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), u * total());
  const auto chosen = above != cumulative_.end() ? above
                                                 : std::lower_bound(cumulative_.begin(), cumulative_.end(), total());
  const auto index = static_cast<std::size_t>(chosen - cumulative_.begin());
  return {index, probability(index)};
}

double DiscreteDistribution::probability(std::size_t index) const {
  RADFARM_DCHECK(index < size());
  if (total() <= 0) return 0;
  return (cumulative_[index] - (index > 0 ? cumulative_[index - 1] : 0.0)) / total();
}

}  // namespace radfarm
