#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "math/vec.h"

namespace radfarm::test {

/// A mesh under construction: for SceneMaker::mesh() and for the dense reference.
struct Shape {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Faces turned over.
  Shape reversed() const {
    Shape turned = *this;
    for (auto& t : turned.triangles) std::swap(t[1], t[2]);
    return turned;
  }
  double area() const {
    double sum = 0;
    for (const auto& t : triangles) {
      const Vec3d a = to_double(positions[t[0]]), b = to_double(positions[t[1]]), c = to_double(positions[t[2]]);
      sum += length(cross(b - a, c - a)) / 2;
    }
    return sum;
  }
};

/// An axis-aligned box of 12 triangles; it faces out.
inline Shape box(const Vec3& low, const Vec3& high) {
  Shape shape;
  for (std::uint32_t i = 0; i < 8; ++i) {
    shape.positions.push_back({(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y, (i & 4U) != 0 ? high.z : low.z});
  }
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2},
                     {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  return shape;
}

/// The regular polygon of `corners` inscribed in a circle about the y axis, of triangles about its centre; it faces up.
inline Shape disc(double radius, double height, std::uint32_t corners) {
  Shape shape;
  shape.positions.push_back(Vec3(0, static_cast<float>(height), 0));
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    shape.positions.push_back(to_float(Vec3d(radius * std::sin(angle), height, radius * std::cos(angle))));
    shape.triangles.push_back({0, 1 + i, 1 + (i + 1) % corners});
  }
  return shape;
}

/// An icosahedron cut into 20 x 4^level triangles with corners on the sphere; it faces out.
inline Shape sphere(double radius, int level) {
  const double g = std::numbers::phi;
  std::vector<Vec3d> p = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                          {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  Shape shape;
  shape.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
      if (is_new) p.push_back(normalize(normalize(p[a]) + normalize(p[b])));
      return place->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : shape.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    shape.triangles = std::move(finer);
  }
  for (const Vec3d& v : p) shape.positions.push_back(to_float(normalize(v) * radius));
  return shape;
}

/// The upper half of a sphere in `rings` of equal height in angle over a disc() of `corners`; it faces in.
inline Shape dome(double radius, std::uint32_t corners, std::uint32_t rings) {
  Shape shape;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const double up = std::numbers::pi / 2 * ring / rings;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      shape.positions.push_back(to_float(
          radius * Vec3d(std::cos(up) * std::sin(angle), std::sin(up), std::cos(up) * std::cos(angle))));
    }
  }
  shape.positions.push_back(Vec3(0, static_cast<float>(radius), 0));
  const auto top = static_cast<std::uint32_t>(shape.positions.size() - 1);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t i = 0; i < corners; ++i) {
      const std::uint32_t a = ring * corners + i, b = ring * corners + (i + 1) % corners;
      if (ring + 1 == rings) {
        shape.triangles.push_back({a, top, b});
        continue;
      }
      shape.triangles.push_back({a, b + corners, b});
      shape.triangles.push_back({a, a + corners, b + corners});
    }
  }
  return shape;
}

}  // namespace radfarm::test
