#include "matter/ggx.h"

#include <cmath>

#include <gtest/gtest.h>

#include "math/sampling.h"
#include "math/sobol.h"
#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kSamples = 1 << 16;

TEST(Ggx, FacetsCoverTheSurfaceOnce) {
  for (const Ggx& ggx : {Ggx{1, 1}, Ggx{0.3F, 0.3F}, Ggx{0.6F, 0.2F}}) {
    double sum = 0;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      sum += static_cast<double>(ggx.distribution(sample_cosine_hemisphere(sobol_owen_2d(s, 3))) * kPi) / kSamples;
    }
    EXPECT_NEAR(sum, 1, 5e-3) << ggx.alpha_x;
  }
}

TEST(Ggx, FacetsSeenAreTheSurfaceSeen) {
  const Ggx ggx{0.7F, 0.3F};
  for (const float cosine : {1.0F, 0.5F, 0.1F}) {
    const Vec3 o = test::towards(cosine);
    double seen = 0, density = 0;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      const Vec3 h = sample_uniform_hemisphere(sobol_owen_2d(s, 4));
      const double weight = 2 * static_cast<double>(kPi) / kSamples;
      seen += weight * static_cast<double>(ggx.masking(o) * std::max(0.0F, dot(o, h)) * ggx.distribution(h));
      density += weight * static_cast<double>(ggx.pdf_visible(o, h));
    }
    EXPECT_NEAR(seen / static_cast<double>(cosine), 1, 5e-3) << cosine;
    EXPECT_NEAR(density, 1, 5e-3) << cosine;
  }
}

TEST(Ggx, VisibilityIsMaskingOverTheCosines) {
  const Ggx ggx{0.4F, 0.1F};
  const Vec3 o = test::towards(0.6F), i = test::towards(0.2F, 2);
  EXPECT_FLOAT_EQ(ggx.visibility(o, i), ggx.masking(o, i) / (4 * o.z * i.z));
  const Vec3 h = normalize(o + i);
  EXPECT_FLOAT_EQ(ggx.pdf_reflected(o, h), ggx.pdf_visible(o, h) / (4 * dot(o, h)));
}

TEST(Ggx, RefractionFollowsSnell) {
  const Vec3 h = normalize(Vec3(0.2F, -0.1F, 1)), o = test::towards(0.6F);
  for (const float eta : {1.5F, 1 / 1.1F}) {
    const Vec3 i = refract(o, h, eta);
    EXPECT_NEAR(static_cast<double>(length(cross(i, h)) * eta), static_cast<double>(length(cross(o, h))), 1e-6);
    EXPECT_LT(dot(i, h), 0);
    EXPECT_NEAR(static_cast<double>(dot(cross(o, h), i)), 0, 1e-6);
  }
  EXPECT_EQ(refract(test::towards(0.2F), {0, 0, 1}, 1 / 1.5F), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace radfarm
