#include "matter/albedo.h"

#include <cmath>

#include <gtest/gtest.h>

#include "math/sobol.h"
#include "matter/fresnel.h"
#include "matter/glass.h"
#include "matter/sheen.h"
#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

TEST(Albedo, OfMirrorsIsTheFormula) {
  for (const float cosine : {1.0F, 0.5F, 0.1F, 0.0F}) {
    EXPECT_FLOAT_EQ(ggx_albedo(cosine, 0).total(), 1);
    EXPECT_FLOAT_EQ(ggx_albedo(cosine, 0).at_90, schlick_weight(cosine));
  }
  EXPECT_FLOAT_EQ(ggx_mean_albedo(0).at_90, 1.0F / 21);
}

// The table's points are its own; 2^16 others know the albedo to 1e-3 or better.
TEST(Albedo, TableAgreesWithTheIntegral) {
  constexpr std::uint32_t kSamples = 1 << 16;
  for (const float roughness : {0.04F, 0.1F, 0.23F, 0.5F, 0.77F, 1.0F}) {
    const Ggx ggx{roughness * roughness, roughness * roughness};
    for (const float cosine : {1e-3F, 0.01F, 0.1F, 0.37F, 0.7F, 1.0F}) {
      const Vec3 o = test::towards(cosine);
      double all = 0;
      for (std::uint32_t s = 0; s < kSamples; ++s) {
        const Vec3 i = reflect(o, ggx.sample_visible(o, sobol_owen_2d(s, 5)));
        if (i.z > 0) all += static_cast<double>(ggx.masking(o, i) / ggx.masking(o)) / kSamples;
      }
      EXPECT_NEAR(static_cast<double>(ggx_albedo(cosine, roughness).total()), all, 5e-3) << roughness << " at " << cosine;
    }
  }
}

TEST(Albedo, MeanIsTheCurvesMean) {
  constexpr int kSteps = 2000;
  for (const float roughness : {0.1F, 0.5F, 1.0F}) {
    const GgxAlbedoCurve curve(roughness);
    double mean = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double cosine = (k + 0.5) / kSteps;
      mean += 2 * cosine / kSteps * static_cast<double>(curve.at(static_cast<float>(cosine)).total());
    }
    EXPECT_NEAR(static_cast<double>(curve.mean().total()), mean, 1e-4);
  }
}

TEST(Albedo, ScaledSheenReflectsAtMostAll) {
  for (const float roughness : {0.0F, 0.05F, 0.1F, 0.2F, 0.4F, 1.0F}) {
    const SheenCurve curve(roughness);
    for (const float cosine : {1e-6F, 1e-3F, 0.01F, 0.03F, 0.1F, 0.5F, 1.0F}) {
      const Vec3 o = test::towards(cosine);
      constexpr int kRoots = 200, kTurns = 100;
      double sum = 0;
      for (int r = 0; r < kRoots; ++r) {
        const float root = (static_cast<float>(r) + 0.5F) / kRoots, z = root * root;
        for (int t = 0; t < kTurns; ++t) {
          const Vec3 i = test::towards(z, 0.3F + kPi * (static_cast<float>(t) + 0.5F) / kTurns);
          sum += static_cast<double>(eval_sheen(roughness, o, i) * curve.scale(cosine, z) * z * 4 * root * kPi) / (kRoots * kTurns);
        }
      }
      EXPECT_LT(sum, 1.005) << roughness << " at " << cosine;
      EXPECT_NEAR(static_cast<double>(curve.at(cosine)), sum, 0.01) << roughness << " at " << cosine;
    }
  }
}

TEST(RoughGlass, FluxBetweenTheSidesBalances) {
  for (const float ior : {1.1F, 1.5F, 2.5F}) {
    const RoughGlass out = rough_glass(ior, 0.6F, true), in = rough_glass(ior, 0.6F, false);
    EXPECT_NEAR(static_cast<double>((1 - out.stays) * out.near.mean.lost()),
                static_cast<double>((1 - in.stays) * in.near.mean.lost() * ior * ior), 1e-5);
    EXPECT_EQ(out.near.mean.lost(), in.far.mean.lost());
  }
}

}  // namespace
}  // namespace radfarm
