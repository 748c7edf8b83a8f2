#include "support/dense_radiosity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/polygon_irradiance.h"

namespace radfarm::test {
namespace {

Vec3d normal_of(const DenseElement& e) { return normalize(cross(e.corners[1] - e.corners[0], e.corners[2] - e.corners[0])); }

struct WeightedPoint {
  Vec3d position{0, 0, 0};
  double weight = 0;
};

/// Centroids of the cells^2 equal parts of each triangle of the fan; the weights add up to 1.
std::vector<WeightedPoint> points_of(const DenseElement& e, int cells) {
  std::vector<WeightedPoint> points;
  const double total = area_of(e), step = 1.0 / cells;
  for (std::size_t i = 1; i + 1 < e.corners.size(); ++i) {
    const Vec3d a = e.corners[0], u = e.corners[i] - a, v = e.corners[i + 1] - a;
    const double weight = length(cross(u, v)) / 2 / total * step * step;
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; row + column < cells; ++column) {
        points.push_back({a + u * ((column + 1.0 / 3) * step) + v * ((row + 1.0 / 3) * step), weight});
        if (row + column + 1 < cells) {
          points.push_back({a + u * ((column + 2.0 / 3) * step) + v * ((row + 2.0 / 3) * step), weight});
        }
      }
    }
  }
  return points;
}

double factor_of_points(const std::vector<WeightedPoint>& from, const Vec3d& normal, const DenseElement& to) {
  const Vec3d to_normal = normal_of(to);
  double sum = 0;
  for (const WeightedPoint& p : from) {
    if (!(dot(p.position - to.corners[0], to_normal) > 0)) continue;
    sum += p.weight * polygon_form_factor(to.corners, p.position, normal);
  }
  return sum;
}

}  // namespace

double area_of(const DenseElement& e) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < e.corners.size(); ++i) {
    sum += length(cross(e.corners[i] - e.corners[0], e.corners[i + 1] - e.corners[0])) / 2;
  }
  return sum;
}

double form_factor(const DenseElement& from, const std::vector<DenseElement>& to, int cells) {
  const std::vector<WeightedPoint> points = points_of(from, cells);
  double sum = 0;
  for (const DenseElement& element : to) sum += factor_of_points(points, normal_of(from), element);
  return sum;
}

std::vector<double> dense_radiosity(const std::vector<DenseElement>& elements, int cells) {
  const std::size_t n = elements.size();
  std::vector<double> f(n * n), b(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<WeightedPoint> points = points_of(elements[i], cells);
    for (std::size_t j = 0; j < n; ++j) f[i * n + j] = i == j ? 0 : factor_of_points(points, normal_of(elements[i]), elements[j]);
    b[i] = elements[i].exitance;
  }
  double change = 1;
  while (change > 1e-12) {
    change = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double arrived = 0;
      for (std::size_t j = 0; j < n; ++j) arrived += f[i * n + j] * b[j];
      const double next = elements[i].exitance + elements[i].reflectance * arrived;
      if (next > 0) change = std::max(change, std::fabs(next - b[i]) / next);
      b[i] = next;
    }
  }
  return b;
}

}  // namespace radfarm::test
