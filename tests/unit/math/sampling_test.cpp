#include "math/sampling.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "math/sobol.h"
#include "math/spectrum.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

TEST(TriangleSolidAngle, OctantIsAnEighthOfTheSphere) {
  EXPECT_NEAR(triangle_solid_angle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), kPiD / 2, 1e-15);
  EXPECT_NEAR(triangle_solid_angle({3, 0, 0}, {0, 0, 0.1}, {0, 70, 0}), kPiD / 2, 1e-14);
}

TEST(TriangleSolidAngle, ObserverInThePlaneSeesHalfTheSphereOrNothing) {
  EXPECT_NEAR(triangle_solid_angle({1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}), 2 * kPiD, 1e-15);
  EXPECT_EQ(triangle_solid_angle({1, 0, 0}, {2, 0, 0}, {1, 1, 0}), 0);
  EXPECT_EQ(triangle_solid_angle({0, 0, 0}, {2, 0, 0}, {1, 1, 0}), 0);
}

TEST(TriangleSolidAngle, SmallTriangleIsAreaOverSquaredDistance) {
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    const double expected = size * size / 2 / 4;
    EXPECT_NEAR(triangle_solid_angle({0, 0, 2}, {size, 0, 2}, {0, size, 2}) / expected, 1, 2 * size * size + 1e-14);
  }
}

TEST(SphericalTriangle, DirectionPointsAtItsBarycentrics) {
  const std::array<Vec3d, 3> v = {Vec3d(1, 0.5, 2), Vec3d(-1, 0.3, 1), Vec3d(0, -2, 3)};
  const Vec3d reference(0.1, 0.2, -0.3);
  const SphericalTriangle triangle(v[0], v[1], v[2], reference);
  ASSERT_TRUE(triangle.in_range());
  EXPECT_FLOAT_EQ(triangle.pdf(), static_cast<float>(1 / triangle.solid_angle()));
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const SphericalTriangle::Sample s = triangle.sample(sobol_owen_2d(i, 1));
    EXPECT_NEAR(static_cast<double>(length(s.direction)), 1, 1e-6);
    const Vec3d b = to_double(s.barycentrics);
    EXPECT_GE(min_component(Spectrum(s.barycentrics.x, s.barycentrics.y, s.barycentrics.z)), 0);
    EXPECT_NEAR(b.x + b.y + b.z, 1, 1e-6);
    const Vec3d expected = normalize(v[0] * b.x + v[1] * b.y + v[2] * b.z - reference);
    EXPECT_LT(length(expected - to_double(s.direction)), 1e-6);
  }
}

TEST(SphericalTriangle, CornersOfTheSquareStayInside) {
  const SphericalTriangle triangle({1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {0, 0, 0});
  for (const float x : {0.0F, 0x1.fffffep-1F}) {
    for (const float y : {0.0F, 0x1.fffffep-1F}) {
      const SphericalTriangle::Sample s = triangle.sample({x, y});
      EXPECT_TRUE(is_finite(s.direction));
      EXPECT_NEAR(s.barycentrics.x + s.barycentrics.y + s.barycentrics.z, 1, 1e-6);
    }
  }
}

TEST(SphericalTriangle, OutOfRangeAsksForAreaSampling) {
  EXPECT_FALSE(SphericalTriangle({0, 0, 1}, {0.01, 0, 1}, {0, 0.01, 1}, {0, 0, 0}).in_range());
  EXPECT_FALSE(SphericalTriangle({-1, -1, 1e-3}, {1, -1, 1e-3}, {0, 1, 1e-3}, {0, 0, 0}).in_range());
  EXPECT_FALSE(SphericalTriangle({1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 0, 0}).in_range());
}

TEST(DiscreteDistribution, ChoosesEachIndexOverItsShare) {
  const std::vector<double> weights = {0, 1, 0, 3, 0};
  const DiscreteDistribution distribution(weights);
  EXPECT_EQ(distribution.total(), 4);
  EXPECT_EQ(distribution.sample(0).index, 1U);
  EXPECT_EQ(distribution.sample(0.2499).index, 1U);
  EXPECT_EQ(distribution.sample(0.25).index, 3U);
  EXPECT_EQ(distribution.sample(0x1.fffffffffffffp-1).index, 3U);
  EXPECT_EQ(distribution.sample(0.5).probability, 0.75);
  EXPECT_EQ(distribution.probability(0), 0);
}

TEST(DiscreteDistribution, NoWeightMeansProbabilityZero) {
  EXPECT_EQ(DiscreteDistribution(std::vector<double>(4, 0.0)).sample(0.7).probability, 0);
  EXPECT_EQ(DiscreteDistribution(std::vector<double>(4, 0.0)).probability(2), 0);
  EXPECT_EQ(DiscreteDistribution().sample(0.7).probability, 0);
}

}  // namespace
}  // namespace radfarm
