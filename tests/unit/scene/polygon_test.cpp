#include "scene/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace radfarm {
namespace {

/// Sum of the triangles' area vectors and of their absolute areas.
std::pair<Vec3d, double> areas(const std::vector<Vec3d>& corners) {
  std::pair<Vec3d, double> sum{Vec3d(0.0), 0};
  for (const auto& t : triangulate_polygon(corners)) {
    const Vec3d area = cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]) * 0.5;
    sum.first += area;
    sum.second += length(area);
  }
  return sum;
}

TEST(Polygon, AConcavePolygonIsCoveredOnceInItsOwnOrientation) {
  // An L of area 3, in the plane x = 2, then turned around.
  std::vector<Vec3d> corners = {{2, 0, 0}, {2, 2, 0}, {2, 2, 1}, {2, 1, 1}, {2, 1, 2}, {2, 0, 2}};
  for (int turns = 0; turns < 6; ++turns) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    EXPECT_EQ(triangulate_polygon(corners).size(), 4U);
    EXPECT_NEAR(areas(corners).first.x, 3, 1e-12);
    EXPECT_NEAR(areas(corners).second, 3, 1e-12);
  }
  std::reverse(corners.begin(), corners.end());
  EXPECT_NEAR(areas(corners).first.x, -3, 1e-12);
  EXPECT_NEAR(areas(corners).second, 3, 1e-12);
}

TEST(Polygon, AStarKeepsItsArea) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    const double radius = i % 2 == 0 ? 2 : 1;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  const double expected = 40 * 0.5 * 2 * 1 * std::sin(2 * std::numbers::pi / 40);
  EXPECT_NEAR(areas(corners).second, expected, 1e-12);
}

TEST(Polygon, DegenerateOutlinesStillGiveNMinusTwoTriangles) {
  const std::vector<Vec3d> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(triangulate_polygon(line).size(), 3U);
  const std::vector<Vec3d> bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate_polygon(bow).size(), 2U);
}

}  // namespace
}  // namespace radfarm
