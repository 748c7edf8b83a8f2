#include "math/sampling.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "math/sobol.h"

namespace radfarm {
namespace {

// H2, H23: E = L sum cos / pdf over directions uniform in the solid angle stays finite and unbiased at the limits of range.
TEST(HardCases, H23SphericalTriangleAtTheLowerLimit) {
  constexpr double kSide = 0.0246;  // Omega just above 3e-4
  const SphericalTriangle triangle({0, 0, 1}, {kSide, 0, 1}, {0, kSide, 1}, {0, 0, 0});
  ASSERT_TRUE(triangle.in_range());
  Vec3d mean(0);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const SphericalTriangle::Sample s = triangle.sample(sobol_owen_2d(i, 7));
    ASSERT_TRUE(is_finite(s.direction));
    mean += to_double(s.barycentrics) / 4096;
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], 1.0 / 3, 1e-3);
}

TEST(HardCases, H2SphericalSliverStaysInside) {
  const SphericalTriangle triangle({-10, 0, 1}, {10, 0, 1}, {0, 1e-3, 1}, {0, 0, 0});
  ASSERT_TRUE(triangle.in_range());
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const SphericalTriangle::Sample s = triangle.sample(sobol_owen_2d(i, 8));
    ASSERT_TRUE(is_finite(s.direction) && is_finite(s.barycentrics));
    EXPECT_NEAR(static_cast<double>(length(s.direction)), 1, 1e-6);
    EXPECT_LE(std::fabs(s.direction.y / s.direction.z), 1.001e-3F);
  }
}

TEST(HardCases, H24SolidAngleApproachesTheHalfSphere) {
  for (const double height : {1e-3, 1e-6, 1e-12}) {
    const double omega = triangle_solid_angle({-1, -1, height}, {1, -1, height}, {0, 1, height});
    EXPECT_LT(omega, 2 * std::numbers::pi + 1e-15);
    EXPECT_NEAR(omega, 2 * std::numbers::pi, 20 * height + 1e-14);
  }
}

}  // namespace
}  // namespace radfarm
