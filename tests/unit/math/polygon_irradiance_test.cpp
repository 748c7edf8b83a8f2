#include "math/polygon_irradiance.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
const Vec3d kUp(0, 0, 1);

double form_factor(const std::vector<Vec3d>& polygon, const Vec3d& receiver, const Vec3d& normal) {
  return polygon_form_factor(polygon, receiver, normal);
}

// ALGORITHMS O5, parallel: rectangle a x b at distance c over its corner, X = a/c, Y = b/c.
double corner_form_factor(double x, double y) {
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPiD);
}

std::vector<Vec3d> ceiling(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {x0, y1, 1}};
}

TEST(PolygonFormFactor, RectangleOverItsCorner) {
  EXPECT_NEAR(form_factor(ceiling(0, 0, 1, 1), Vec3d(0), kUp), 0.1385316060, 5e-11);
  EXPECT_NEAR(form_factor(ceiling(-1, -1, 1, 1), Vec3d(0), kUp), 0.5541264240, 5e-11);
  for (const double x : {1e-3, 0.1, 1.0, 7.0, 300.0}) {
    for (const double y : {1e-3, 0.5, 20.0}) {
      EXPECT_NEAR(form_factor(ceiling(0, 0, x, y), Vec3d(0), kUp), corner_form_factor(x, y), 1e-12);
    }
  }
}

// O5, perpendicular: the rectangle b x c stands off by a along the normal's plane; X = a/b, Y = c/b in the usual figure.
TEST(PolygonFormFactor, RectanglePerpendicularToTheReceiver) {
  for (const double distance : {0.01, 0.5, 1.0, 4.0}) {
    for (const double height : {0.1, 1.0, 3.0}) {
      // Width 1 along y, from the receiver's corner; height along the normal.
      const std::vector<Vec3d> wall = {{distance, 0, 0}, {distance, 1, 0}, {distance, 1, height}, {distance, 0, height}};
      const double diagonal = std::hypot(distance, height);
      const double expected = (std::atan(1 / distance) - distance / diagonal * std::atan(1 / diagonal)) / (2 * kPiD);
      EXPECT_NEAR(form_factor(wall, Vec3d(0), kUp), expected, 1e-12);
    }
  }
}

// O6: a wall so long that its ends do not matter at 1e-12.
TEST(PolygonFormFactor, FloorPointBeforeAnInfiniteWall) {
  constexpr double kHalf = 1e8;
  const std::vector<Vec3d> wall = {{0, -kHalf, 0}, {0, kHalf, 0}, {0, kHalf, 1}, {0, -kHalf, 1}};
  EXPECT_NEAR(form_factor(wall, {0.1, 0, 0}, kUp), 0.4502481405, 5e-11);
  EXPECT_NEAR(form_factor(wall, {1, 0, 0}, kUp), 0.1464466094, 5e-11);
  EXPECT_NEAR(form_factor(wall, {10, 0, 0}, kUp), 0.00248140490, 5e-12);
  for (const double x : {0.1, 1.0, 10.0}) {
    EXPECT_NEAR(form_factor(wall, {x, 0, 0}, kUp), 0.5 * (1 - x / std::hypot(x, 1)), 1e-12);
  }
}

// O4: a disc of radius r at height h, as the sum of thin triangles.
TEST(PolygonFormFactor, DiscAsAFanOfTriangles) {
  constexpr int kSides = 4096;
  const auto disc = [](double radius, double height, const Vec3d& receiver) {
    // The radius that gives the polygon the disc's own area.
    const double r = radius * std::sqrt(2 * kPiD / kSides / std::sin(2 * kPiD / kSides));
    const auto corner = [&](int i) {
      return Vec3d(r * std::cos(2 * kPiD * i / kSides), r * std::sin(2 * kPiD * i / kSides), height);
    };
    double sum = 0;
    for (int i = 0; i < kSides; ++i) sum += form_factor({{0, 0, height}, corner(i), corner(i + 1)}, receiver, kUp);
    return sum;
  };
  EXPECT_NEAR(disc(1, 2, Vec3d(0)), 0.2, 1e-6);
  EXPECT_NEAR(disc(1, 0.5, {1, 0, 0}), 0.3787321875, 1e-6);  // (h, a, r) = (.5, 1, 1)
  EXPECT_NEAR(disc(1, 1, {0.5, 0, 0}), 0.4379826327, 1e-6);
  EXPECT_NEAR(disc(1, 1, {2, 0, 0}), 0.0527864045, 1e-6);
}

TEST(PolygonFormFactor, HalfTheSkyIsHalf) {
  constexpr double kFar = 1e9;
  EXPECT_NEAR(form_factor({{-kFar, -kFar, 1}, {kFar, -kFar, 1}, {kFar, kFar, 1}, {-kFar, kFar, 1}}, Vec3d(0), kUp), 1, 1e-12);
  EXPECT_NEAR(form_factor({{0, -kFar, 1}, {kFar, -kFar, 1}, {kFar, kFar, 1}, {0, kFar, 1}}, Vec3d(0), kUp), 0.5, 1e-9);
}

TEST(PolygonFormFactor, PartsAddUpAndWindingDoesNotMatter) {
  RandomSequence random(3);
  const auto coordinate = [&] { return 2 * random.uniform_double() - 1; };
  for (int i = 0; i < 2000; ++i) {
    const Vec3d a(coordinate(), coordinate(), coordinate()), b(coordinate(), coordinate(), coordinate());
    const Vec3d c(coordinate(), coordinate(), coordinate());
    const Vec3d receiver(coordinate(), coordinate(), coordinate());
    const Vec3d normal = normalize(Vec3d(coordinate(), coordinate(), coordinate()));
    const Vec3d middle = a + (b - a) * random.uniform_double();
    const double whole = form_factor({a, b, c}, receiver, normal);
    EXPECT_NEAR(form_factor({c, b, a}, receiver, normal), whole, 1e-13);
    EXPECT_NEAR(form_factor({b, c, a}, receiver, normal), whole, 1e-13);
    EXPECT_NEAR(form_factor({a, middle, c}, receiver, normal) + form_factor({middle, b, c}, receiver, normal), whole, 1e-13);
    EXPECT_NEAR(form_factor({a, middle, b, c}, receiver, normal), whole, 1e-13);
  }
}

TEST(PolygonFormFactor, OctagonIsTheSumOfItsFan) {
  std::vector<Vec3d> octagon;
  for (int i = 0; i < 8; ++i) octagon.emplace_back(std::cos(kPiD * i / 4), std::sin(kPiD * i / 4), 0.3 + 0.1 * std::cos(kPiD * i / 4));
  const Vec3d normal = normalize(Vec3d(1, 0.5, 0.1));
  double sum = 0;
  for (std::size_t i = 1; i < 7; ++i) sum += form_factor({octagon[0], octagon[i], octagon[i + 1]}, Vec3d(0.2, 0.1, 0), normal);
  EXPECT_NEAR(form_factor(octagon, Vec3d(0.2, 0.1, 0), normal), sum, 1e-14);
}

TEST(PolygonFormFactor, FastVariantAgrees) {
  RandomSequence random(5);
  const auto point = [&] {
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    return Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  };
  for (int i = 0; i < 20'000; ++i) {
    const float scale = std::exp2(-20 * random.uniform());
    const Vec3 centre = point();
    const std::array<Vec3, 3> triangle = {centre + point() * scale, centre + point() * scale, centre + point() * scale};
    const std::vector<Vec3d> exact = {to_double(triangle[0]), to_double(triangle[1]), to_double(triangle[2])};
    const Vec3 receiver = point();
    const Vec3 normal = normalize(point());
    const double expected = form_factor(exact, to_double(receiver), to_double(normal));
    EXPECT_NEAR(static_cast<double>(fast_polygon_form_factor(triangle, receiver, normal)), expected, 1e-8 + 1e-6 * expected);
  }
}

}  // namespace
}  // namespace radfarm
