#include "matter/fresnel.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

float cosine_of(double degrees) { return static_cast<float>(std::cos(degrees * std::numbers::pi / 180)); }

// Oracle O17.
TEST(Fresnel, PanePassesWhatTheClosedFormSays) {
  struct Row {
    double degrees, passes;
  };
  for (const Row& row : std::array{Row{0, 0.91832}, Row{30, 0.91596}, Row{45, 0.90253}, Row{60, 0.84347}, Row{75, 0.61481}}) {
    EXPECT_NEAR(static_cast<double>(pane_transmittance(cosine_of(row.degrees), 1.52F)), row.passes, 1e-5) << row.degrees;
  }
  EXPECT_NEAR(static_cast<double>(pane_transmittance(1, 1.5F)), 0.92308, 1e-5);
  EXPECT_NEAR(static_cast<double>(pane_transmittance(0, 1.5F)), 0, 1e-6);
}

TEST(Fresnel, NormalIncidence) {
  for (const float ior : {1.1F, 1.5F, 2.5F, 100.0F}) {
    EXPECT_NEAR(static_cast<double>(fresnel_dielectric(1, ior)), static_cast<double>(normal_reflectance(ior)), 1e-6);
    EXPECT_NEAR(static_cast<double>(fresnel_dielectric(1, 1 / ior)), static_cast<double>(normal_reflectance(ior)), 1e-6);
  }
}

TEST(Fresnel, AtBrewstersAngleOnePolarisationVanishes) {
  for (const double ior : {1.2, 1.5, 2.5}) {
    const double cosine = 1 / std::sqrt(1 + ior * ior);
    const double s = (1 - ior * ior) / (1 + ior * ior);
    const double reflected = static_cast<double>(fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(ior)));
    EXPECT_NEAR(reflected, s * s / 2, 1e-6);
  }
}

TEST(Fresnel, BeyondTheCriticalAngleAllIsReflected) {
  const float eta = 1 / 1.5F;
  const float critical = std::sqrt(1 - eta * eta);
  EXPECT_EQ(fresnel_dielectric(critical * 0.999F, eta), 1);
  EXPECT_EQ(fresnel_dielectric(0, eta), 1);
  EXPECT_LT(fresnel_dielectric(critical * 1.001F, eta), 0.9F);
}

TEST(Fresnel, BothSidesReflectTheSameAlongOneRay) {
  const float ior = 1.5F;
  for (const float cosine : {1.0F, 0.8F, 0.5F, 0.2F, 0.05F}) {
    const float inside = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    EXPECT_NEAR(static_cast<double>(fresnel_dielectric(cosine, ior)), static_cast<double>(fresnel_dielectric(inside, 1 / ior)),
                5e-6);  // rounding of `inside`, times dF/dcosine at grazing
  }
}

TEST(Fresnel, NothingHappensAtIndexOne) {
  for (const float cosine : {1.0F, 0.5F, 1e-7F, 0.0F}) {
    EXPECT_EQ(fresnel_dielectric(cosine, 1), 0);
    EXPECT_EQ(pane_transmittance(cosine, 1), 1);
  }
}

TEST(Pane, WhatItPassesAndReflectsIsAll) {
  for (const float transmission : {1.0F, 0.5F}) {
    Matter pane = test::thin_glass(0);
    pane.transmission = transmission, pane.ior = 1.52F;
    ASSERT_TRUE(pane.is_pane());
    for (const float cosine : {1.0F, 0.7F, 0.3F, 0.05F, 1e-3F}) {
      const Bsdf bsdf = test::bsdf_of(pane, test::towards(cosine));
      const double passes = static_cast<double>(luminance(pane_passage(pane, cosine)));
      if (transmission == 1) {
        EXPECT_NEAR(passes, static_cast<double>(pane_transmittance(cosine, 1.52F)), 1e-6);
      }
      EXPECT_NEAR(passes + luminance(test::sampled_albedo(bsdf).all()), 1, 2e-3) << cosine;
    }
  }
}

}  // namespace
}  // namespace radfarm
