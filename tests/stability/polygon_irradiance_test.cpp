#include "math/polygon_irradiance.h"

#include <array>
#include <cmath>
#include <functional>
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

/// A rotation and a shift, so that nothing is axis-aligned.
struct Pose {
  Vec3d x = normalize(Vec3d(1, 2, 3));
  Vec3d y = normalize(cross(Vec3d(1, 2, 3), Vec3d(-2, 0.5, 1)));
  Vec3d z = cross(x, y);
  Vec3d shift{0.3, -0.7, 0.11};
  Vec3d point(const Vec3d& p) const { return direction(p) + shift; }
  Vec3d direction(const Vec3d& d) const { return x * d.x + y * d.y + z * d.z; }
  std::vector<Vec3d> polygon(const std::vector<Vec3d>& points) const {
    std::vector<Vec3d> posed;
    for (const Vec3d& p : points) posed.push_back(point(p));
    return posed;
  }
};

/// The integral over [0, 1]^2 of a function that may be singular at the sides: double exponential quadrature.
double integral(const std::function<double(double, double)>& f) {
  struct Node {
    double x, weight;
  };
  std::vector<Node> nodes;
  constexpr double kStep = 1.0 / 16;
  for (int i = -52; i <= 52; ++i) {
    const double t = i * kStep;
    const double e = std::exp(-kPiD * std::sinh(t));
    nodes.push_back({1 / (1 + e), kStep * kPiD * std::cosh(t) * e / ((1 + e) * (1 + e))});
  }
  double sum = 0;
  for (const Node& a : nodes) {
    for (const Node& b : nodes) sum += a.weight * b.weight * f(a.x, b.x);
  }
  return sum;
}

// H2: a sliver of aspect 1e6 is a strip; its form factor is that of the thin strip at the same place.
TEST(HardCases, H2SliverHasItsStripsFormFactor) {
  constexpr double kThin = 1e-6;
  const std::vector<Vec3d> strip = {{0, 0, 1}, {1, 0, 1}, {1, kThin, 1}, {0, kThin, 1}};
  const std::vector<Vec3d> sliver = {{0, 0, 1}, {1, 0, 1}, {1, kThin, 1}};
  const std::vector<Vec3d> other_half = {{0, 0, 1}, {1, kThin, 1}, {0, kThin, 1}};
  const double expected = kThin * (0.5 * std::atan(1.0) + 0.25) / kPiD;  // the integral of 1 / (pi (1 + x^2)^2)
  EXPECT_NEAR(form_factor(strip, Vec3d(0), kUp) / expected, 1, 1e-10);
  const double halves = form_factor(sliver, Vec3d(0), kUp) + form_factor(other_half, Vec3d(0), kUp);
  EXPECT_NEAR(halves / expected, 1, 1e-10);
}

// H20, O2: unit squares with a common edge, integrated over the receiver up to the edge.
TEST(HardCases, H20TouchingSquares) {
  const std::vector<Vec3d> wall = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double touching = integral([&](double x, double y) { return form_factor(wall, {x, y, 0}, kUp); });
  EXPECT_NEAR(touching, 0.2000437761, 1e-9);
  const Pose pose;
  const std::vector<Vec3d> posed = pose.polygon(wall);
  EXPECT_NEAR(integral([&](double x, double y) { return form_factor(posed, pose.point({x, y, 0}), pose.direction(kUp)); }),
              0.2000437761, 1e-9);
}

// H20, O6: x -> 0.
TEST(HardCases, H20FloorPointNearTheFootOfALongWall) {
  const std::vector<Vec3d> wall = {{0, -1e6, 0}, {0, 1e6, 0}, {0, 1e6, 1}, {0, -1e6, 1}};
  EXPECT_NEAR(form_factor(wall, {1e-6, 0, 0}, kUp), 0.4999995, 1e-12);
  for (const double x : {1e-3, 1e-9, 1e-12, 1e-15, 0.0}) {
    EXPECT_NEAR(form_factor(wall, {x, 0, 0}, kUp), 0.5 * (1 - x / std::hypot(x, 1)), 1e-11) << x;
    EXPECT_NEAR(form_factor(wall, {-x, 0, 0}, kUp), 0.5 * (1 - x / std::hypot(x, 1)), 1e-11) << x;
  }
}

TEST(HardCases, H21ReceiverOnTheEmittersPlane) {
  const std::vector<Vec3d> floor_light = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(form_factor(floor_light, Vec3d(0), kUp), 0);
  EXPECT_EQ(form_factor(floor_light, {1.5, 0.5, 0}, kUp), 0);
  EXPECT_EQ(form_factor(floor_light, {1, 0, 0}, -kUp), 0);
  // In the plane of an emitter that stands up: it is seen edge-on.
  EXPECT_NEAR(form_factor({{1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}}, Vec3d(0), kUp), 0, 1e-15);
  const Pose pose;
  EXPECT_NEAR(form_factor(pose.polygon(floor_light), pose.shift, pose.direction(kUp)), 0, 1e-6);
}

TEST(HardCases, H21ReceiverOnTheEdgeOrCornerOfAWall) {
  const std::vector<Vec3d> wall = {{0, -1, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 1}};
  EXPECT_NEAR(form_factor(wall, Vec3d(0), kUp), 0.5, 1e-12);
  EXPECT_NEAR(form_factor(wall, {0, 0.7, 0}, kUp), 0.5, 1e-12);
  EXPECT_NEAR(form_factor(wall, {0, 1, 0}, kUp), 0.25, 1e-12);     // at the end: a quarter
  EXPECT_NEAR(form_factor(wall, {0, 0.5, 0.5}, kUp), 0.5, 1e-12);  // on the wall: its lower part is under the horizon
  const Pose pose;
  EXPECT_NEAR(form_factor(pose.polygon(wall), pose.point({0, 0.7, 0}), pose.direction(kUp)), 0.5, 1e-6);
}

// H22: the receiver's normal almost perpendicular to the direction of a small emitter.
TEST(HardCases, H22GrazingIncidenceFallsLinearly) {
  const std::vector<Vec3d> light = {{1, -1e-4, -1e-4}, {1, 1e-4, -1e-4}, {1, 1e-4, 1e-4}, {1, -1e-4, 1e-4}};
  const double facing = form_factor(light, Vec3d(0), {1, 0, 0});
  double previous = facing;
  for (const double cosine : {1e-1, 1e-3, 1e-5, 1e-7, 0.0, -1e-5}) {
    const double grazing = form_factor(light, Vec3d(0), {cosine, 0, std::sqrt(1 - cosine * cosine)});
    EXPECT_GE(grazing, 0);
    EXPECT_LE(grazing, previous);
    if (cosine >= 1e-3) {
      EXPECT_NEAR(grazing, facing * cosine, 1e-6 * facing);
    }
    previous = grazing;
  }
  // Wholly above the horizon it stays linear all the way down.
  const std::vector<Vec3d> point_like = {{1, -1e-8, 0}, {1, 1e-8, 0}, {1, 0, 1e-8}};
  const double small = form_factor(point_like, Vec3d(0), {1, 0, 0});
  EXPECT_NEAR(form_factor(point_like, Vec3d(0), {1e-7, 0, 1}) / small, 1e-7 + 1e-8 / 3, 1e-12);
}

// H23: the point-light limit cos cos' A / (pi r^2), relatively, however small the emitter and wherever it stands.
TEST(HardCases, H23TinyEmitterIsAPointLight) {
  RandomSequence random(23);
  for (const double size : {1e-3, 1e-5, 1e-7, 1e-9}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3d centre(random.uniform_double() - 0.5, random.uniform_double() - 0.5, 1);
      const Vec3d a = normalize(Vec3d(1, random.uniform_double(), random.uniform_double())) * size;
      const Vec3d b = normalize(Vec3d(random.uniform_double() - 0.5, 1, -0.3)) * size;
      // The receiver is the origin, so that the vertices, not their rounding against an offset, are tested.
      const std::vector<Vec3d> light = {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
      const Vec3d area = cross(light[1] - light[0], light[3] - light[0]);
      const double r = length(centre);
      const double expected = centre.z * std::fabs(dot(centre, area)) / (r * r * r * r) / kPiD;
      const double got = form_factor(light, Vec3d(0), kUp);
      // The limit holds to size^2; vertices given as doubles know the emitter's shape to 1e-16 / size.
      EXPECT_NEAR(got / expected, 1, 10 * size * size + 1e-14 / size) << size;
    }
  }
}

TEST(HardCases, H23EmitterOfTinyAreaSeenFromAfar) {
  const std::vector<Vec3d> light = {{0, 0, 0}, {1e-6, 0, 0}, {1e-6, 1e-6, 0}, {0, 1e-6, 0}};
  for (const double distance : {1e-3, 1.0, 1e3, 1e6}) {
    const double expected = 1e-12 / (kPiD * distance * distance);
    EXPECT_NEAR(form_factor(light, {0, 0, -distance}, kUp) / expected, 1, 1e-4);
    const std::array<Vec3, 4> floats = {to_float(light[0]), to_float(light[1]), to_float(light[2]), to_float(light[3])};
    const float fast = fast_polygon_form_factor(floats, {0, 0, static_cast<float>(-distance)}, {0, 0, 1});
    EXPECT_NEAR(static_cast<double>(fast) / expected, 1, 1e-4);
  }
}

TEST(HardCases, H24SkySizedEmitterFillsTheHemisphere) {
  for (const double size : {1e3, 1e6, 1e9, 1e12}) {
    const std::vector<Vec3d> sky = {{-size, -size, 1}, {size, -size, 1}, {size, size, 1}, {-size, size, 1}};
    EXPECT_NEAR(form_factor(sky, Vec3d(0), kUp), 1, 2 / size + 1e-12);
    EXPECT_LE(form_factor(sky, Vec3d(0), kUp), 1);
    EXPECT_NEAR(form_factor(sky, Vec3d(0), {1, 0, 0}), 0.5, 2 / size + 1e-12);
  }
}

TEST(HardCases, DegeneratePolygonsGiveZero) {
  EXPECT_EQ(form_factor({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, Vec3d(0), kUp), 0);
  EXPECT_NEAR(form_factor({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}, Vec3d(0), kUp), 0, 1e-16);
  EXPECT_EQ(form_factor({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, Vec3d(0), kUp), 0);
  EXPECT_NEAR(form_factor({{0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {0, 1, 1}}, Vec3d(0), kUp),
              form_factor({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, Vec3d(0), kUp), 1e-15);
}

}  // namespace
}  // namespace radfarm
