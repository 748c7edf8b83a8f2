#include "scene/polygon.h"

#include <cmath>
#include <numeric>

namespace radfarm {
namespace {

struct Point {
  double x, y;
};

/// Twice the signed area of the triangle.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners seen against their area vector (Newell), so that the polygon runs counter-clockwise.
std::vector<Point> projected(std::span<const Vec3d> corners) {
  Vec3d area(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  const double x = std::fabs(area.x);
  const double y = std::fabs(area.y);
  const double z = std::fabs(area.z);
  std::vector<Point> points;
  for (const Vec3d& p : corners) {
    Point point{p.x, p.y};
    double sign = area.z;
    if (x >= y && x >= z) {
      point = {p.y, p.z};
      sign = area.x;
    } else if (y >= z) {
      point = {p.z, p.x};
      sign = area.y;
    }
    points.push_back({sign < 0 ? -point.x : point.x, point.y});
  }
  return points;
}

std::vector<std::array<std::uint32_t, 3>> fan(std::size_t corners) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

bool is_convex(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  }
  return true;
}

/// Whether the corner at `at` of the remaining ring can be cut off: it turns left and no other corner lies in it.
bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Point& a = points[ring[(at + n - 1) % n]];
  const Point& b = points[ring[at]];
  const Point& c = points[ring[(at + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Point& p = points[ring[(at + k) % n]];
    const bool is_corner = (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
    if (!is_corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const Vec3d> corners) {
  if (corners.size() == 3) return fan(3);
  const std::vector<Point> points = projected(corners);
  if (is_convex(points)) return fan(corners.size());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0U);
  std::size_t at = 0;
  std::size_t refused = 0;  // corners in a row that were no ears
  while (ring.size() > 3) {
    if (refused == ring.size()) return fan(corners.size());
    if (!is_ear(points, ring, at)) {
      at = (at + 1) % ring.size();
      ++refused;
      continue;
    }
    const std::size_t n = ring.size();
    triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at %= ring.size();
    refused = 0;
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace radfarm
