#include "math/polygon_irradiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace radfarm {
namespace {

/// A convex polygon relative to the receiver. The horizon's plane adds at most one vertex.
struct Polygon {
  std::array<Vec3d, kMaxPolygonVertices + 1> points;
  std::size_t size = 0;
  void add(const Vec3d& point) { points[size++] = point; }
};

/// Cuts off what lies below the horizon; leaves nothing when nothing lies strictly above it.
void clip_to_horizon(Polygon& polygon, const Vec3d& normal) {
  std::array<double, kMaxPolygonVertices + 1> heights;
  double highest = 0;
  double lowest = 0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    heights[i] = dot(polygon.points[i], normal);
    highest = std::max(highest, heights[i]);
    lowest = std::min(lowest, heights[i]);
  }
  if (lowest >= 0 && highest > 0) return;
  Polygon above;
  for (std::size_t i = 0; i < polygon.size && highest > 0; ++i) {
    const std::size_t next = i + 1 < polygon.size ? i + 1 : 0;
    const Vec3d& a = polygon.points[i];
    const Vec3d& b = polygon.points[next];
    if (heights[i] >= 0) above.add(a);
    const bool crosses = (heights[i] > 0 && heights[next] < 0) || (heights[i] < 0 && heights[next] > 0);
    if (crosses) above.add(a + (b - a) * (heights[i] / (heights[i] - heights[next])));
  }
  polygon = above;
}

/// Unit normal of the polygon's plane, on the side that `normal` points to.
Vec3d plane_normal(const Polygon& polygon, const Vec3d& normal) {
  Vec3d sum(0);
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    sum += cross(polygon.points[i] - polygon.points[0], polygon.points[i + 1] - polygon.points[0]);
  }
  sum = normalize(sum);
  return dot(sum, normal) < 0 ? -sum : sum;
}

/// An edge from p to q as the receiver sees it; Theta is the angle between p and q.
struct Edge {
  double cosine;             // of Theta
  double squared_moment;     // |p x q|^2
  double inverse_product;    // 1 / (|p| |q|), so sin Theta = |p x q| * inverse_product
};

constexpr double kTouchingSine = 2e-15;  // opposite directions, as far as doubles can tell: the receiver is on the edge
constexpr double kLift = 1e-100;         // how far a vertex at the receiver is moved, relative to the polygon

/// (Theta - sin Theta) / |p x q|.
struct ExactWeight {
  static double of(const Edge& edge) {
    const double moment = std::sqrt(edge.squared_moment);
    if (moment == 0) return 0;
    const double sine = moment * edge.inverse_product;
    const double angle = std::atan2(sine, edge.cosine);
    if (angle > 0.25) return (angle - sine) / moment;
    const double x = angle * angle;
    return angle * x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72 * (1 - x / 110 * (1 - x / 156))))) / moment;
  }
};

/// acos(c) / sqrt(1 - c^2) on [0, 1] to 3.3e-9: its interpolant at the Chebyshev nodes.
double angle_ratio(double c) {
  constexpr std::array<double, 11> k = {1.5707963235258356,    -0.99999920579296841, 0.78536576713226573,
                                        -0.66614234455392995,  0.58460294515185944,  -0.51069299369469758,
                                        0.415807040121917,     -0.28580596007442679, 0.14669184078810187,
                                        -0.047913828594184775, 0.0072904176719619046};
  const double c2 = c * c;
  const double c4 = c2 * c2;
  const double low = (k[0] + k[1] * c) + (k[2] + k[3] * c) * c2;
  const double middle = (k[4] + k[5] * c) + (k[6] + k[7] * c) * c2;
  const double high = (k[8] + k[9] * c) + k[10] * c2;
  return low + (middle + high * c4) * c4;
}

/// The same by that polynomial: Theta = sin Theta * angle_ratio(cosine), and pi minus it beyond the right angle.
struct FastWeight {
  static double of(const Edge& edge) {
    const double ratio = angle_ratio(std::fabs(edge.cosine));
    if (edge.cosine >= 0) return (ratio - 1) * edge.inverse_product;
    return std::numbers::pi / std::sqrt(edge.squared_moment) - (ratio + 1) * edge.inverse_product;
  }
};

/// The polygon with the receiver's distance from each vertex. A vertex at the receiver has no direction; seen from a little
/// behind the plane it lies along the plane's normal, so it is lifted there.
std::array<double, kMaxPolygonVertices + 1> lengths_and_lift(Polygon& polygon, const Vec3d& normal) {
  std::array<double, kMaxPolygonVertices + 1> lengths;
  double longest = 0;
  double shortest = HUGE_VAL;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    lengths[i] = std::sqrt(dot(polygon.points[i], polygon.points[i]));
    longest = std::max(longest, lengths[i]);
    shortest = std::min(shortest, lengths[i]);
  }
  if (shortest > 0) return lengths;
  const Vec3d lifted = plane_normal(polygon, normal) * (longest * kLift);
  for (std::size_t i = 0; i < polygon.size; ++i) {
    if (lengths[i] > 0) continue;
    polygon.points[i] = lifted;
    lengths[i] = longest * kLift;
  }
  return lengths;
}

/// |sum_i Theta_i Gamma_i . n| / (2 pi) of a polygon that is above the horizon, as sum (Theta_i - sin Theta_i) Gamma_i plus
/// sum u_i x u_{i+1}, the latter taken about u_0 as sum s_i x s_{i+1} with s_i = u_i - u_0: no cancellation at any size.
template <typename Weight>
double form_factor(Polygon& polygon, const Vec3d& normal) {
  if (polygon.size < 3) return 0;
  const auto lengths = lengths_and_lift(polygon, normal);
  const Vec3d& origin = polygon.points[0];
  Vec3d sum(0);
  Vec3d previous(0);  // s_i
  double inverse_length = 1 / lengths[0];
  const Vec3d first = origin * inverse_length;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const std::size_t next = i + 1 < polygon.size ? i + 1 : 0;
    const Vec3d& p = polygon.points[i];
    const Vec3d& q = polygon.points[next];
    const double next_inverse_length = 1 / lengths[next];

    // s = (q - p0) / |q| - u0 (|q| - |p0|) / |q|, the difference of lengths from the difference of points.
    const Vec3d step = q - origin;
    const double growth = dot(step, q + origin) / (lengths[next] + lengths[0]);
    const Vec3d current = (step - first * growth) * next_inverse_length;
    sum += cross(previous, current);
    previous = current;

    const Vec3d moment = cross(p, q - p);
    const double inverse_product = inverse_length * next_inverse_length;
    const Edge edge{dot(p, q) * inverse_product, dot(moment, moment), inverse_product};
    inverse_length = next_inverse_length;
    if (edge.cosine < 0 && std::sqrt(edge.squared_moment) * inverse_product < kTouchingSine) {
      sum += normalize(cross(plane_normal(polygon, normal), q - p)) * std::numbers::pi;
    } else {
      sum += moment * Weight::of(edge);
    }
  }
  return std::min(1.0, std::fabs(dot(sum, normal)) / (2 * std::numbers::pi));
}

}  // namespace

double polygon_form_factor(std::span<const Vec3d> polygon, const Vec3d& receiver, const Vec3d& normal) {
  RADFARM_DCHECK(polygon.size() >= 3 && polygon.size() <= kMaxPolygonVertices);
  Polygon relative;
  for (const Vec3d& vertex : polygon) relative.add(vertex - receiver);
  clip_to_horizon(relative, normal);
  return form_factor<ExactWeight>(relative, normal);
}

float fast_polygon_form_factor(std::span<const Vec3> polygon, const Vec3& receiver, const Vec3& normal) {
  RADFARM_DCHECK(polygon.size() >= 3 && polygon.size() <= kMaxPolygonVertices);
  const Vec3d origin = to_double(receiver);
  const Vec3d up = to_double(normal);
  Polygon relative;
  for (const Vec3& vertex : polygon) relative.add(to_double(vertex) - origin);
  clip_to_horizon(relative, up);
  return static_cast<float>(form_factor<FastWeight>(relative, up));
}

}  // namespace radfarm
