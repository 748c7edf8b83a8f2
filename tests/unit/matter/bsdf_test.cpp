#include "matter/bsdf.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "matter/fresnel.h"
#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

struct Named {
  std::string name;
  Matter matter;
};

Matter colored(Matter m) {
  m.base = {0.9F, 0.5F, 0.2F};
  m.specular_color = {1, 0.6F, 0.3F};
  return m;
}

std::vector<Named> reflecting() {
  std::vector<Named> all;
  for (const float roughness : {0.05F, 0.3F, 1.0F}) {
    const std::string r = std::to_string(roughness).substr(0, 4);
    all.push_back({"metal " + r, colored(test::white_metal(roughness))});
    all.push_back({"dielectric " + r, colored(test::white_dielectric(roughness))});
    all.push_back({"coated " + r, test::coated(colored(test::white_metal(roughness)), 0.2F)});
    all.push_back({"sheen " + r, test::with_sheen(colored(test::white_dielectric(0.4F)), roughness)});
    all.push_back({"anisotropic " + r, colored(test::anisotropic(roughness, 0.6F))});
    all.push_back({"thin " + r, colored(test::thin_glass(roughness))});
    Matter half = colored(test::thin_glass(roughness));
    half.transmission = half.metallic = 0.5F;
    all.push_back({"half thin " + r, half});
  }
  return all;
}

// f(o, i) seen from i: the frame stands on the viewer's side. The roundings are of the half vector, 2^-24 over its length, against
// alpha: where directions are not near grazing and alpha >= 0.0025, 1e-7 / 0.0025 four times over (D ~ h^4), with head room 2e-3.
constexpr double kRounding = 2e-3;

Spectrum seen_from(const Matter& m, const Vec3& o, const Vec3& i, bool is_front) {
  const float side = o.z > 0 ? 1.0F : -1.0F;
  Frame frame(Vec3(0, 0, side));
  frame.tangent = {1, 0, 0};
  frame.bitangent = {0, side, 0};
  const Bsdf bsdf(m, frame, o, is_front);
  return bsdf.eval_specular(i) + bsdf.eval_diffuse(i);
}

Vec3 random_direction(RandomSequence& random) {
  const float z = 0.05F + 0.95F * random.uniform();
  return test::towards(z, 6.2F * random.uniform());
}

void expect_equal(const Spectrum& a, const Spectrum& b, const std::string& name) {
  for (const auto& [x, y] : {std::pair{a.r, b.r}, std::pair{a.g, b.g}, std::pair{a.b, b.b}}) {
    const double larger = static_cast<double>(std::max(std::fabs(x), std::fabs(y)));
    ASSERT_NEAR(static_cast<double>(x), static_cast<double>(y), kRounding * larger + 1e-9) << name;
  }
}

TEST(Bsdf, IsReciprocal) {
  RandomSequence random(1);
  for (const Named& named : reflecting()) {
    for (int k = 0; k < 2000; ++k) {
      const Vec3 o = random_direction(random);
      Vec3 i = random_direction(random);
      expect_equal(seen_from(named.matter, o, i, true), seen_from(named.matter, i, o, true), named.name + " above");
      i.z = -i.z;
      expect_equal(seen_from(named.matter, o, i, true), seen_from(named.matter, i, o, true), named.name + " through");
    }
  }
}

// L = n^2 L' with L' basic: what f carries of L' obeys f(o, i) / n_i^2 = f(i, o) / n_o^2, from Helmholtz's f_L(o, i) / n_o^2 =
// f_L(i, o) / n_i^2 [Veach 1997, 5.2] and f = f_L n_i^2 / n_o^2. With n = 1 outside: f(out, in) = ior^2 f(in, out).
TEST(Bsdf, RefractionIsReciprocalInBasicRadiance) {
  RandomSequence random(2);
  int lit = 0;
  for (const float ior : {1.2F, 1.5F, 2.5F}) {
    for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
      Matter m = test::solid_glass(roughness, ior);
      m.base = {0.9F, 0.5F, 0.2F};
      for (int k = 0; k < 2000; ++k) {
        const Vec3 o = random_direction(random);
        Vec3 i = random_direction(random);
        i.z = -i.z;
        const Spectrum outside = seen_from(m, o, i, true), inside = seen_from(m, i, o, false);
        expect_equal(outside, inside * (ior * ior), std::to_string(ior));
        lit += luminance(outside) > 0.01F ? 1 : 0;
      }
    }
  }
  EXPECT_GT(lit, 5000);
}

TEST(Bsdf, WeightIsValueTimesCosineOverDensity) {
  RandomSequence random(3);
  std::vector<Named> all = reflecting();
  all.push_back({"glass", colored(test::solid_glass(0.4F))});
  for (const Named& named : all) {
    for (int k = 0; k < 2000; ++k) {
      const Bsdf bsdf = test::bsdf_of(named.matter, random_direction(random), k % 2 == 0);
      const float u = random.uniform();
      const Bsdf::Sample sample = bsdf.sample_specular(random.uniform(), {u, random.uniform()});
      if (is_black(sample.weight)) continue;
      ASSERT_FALSE(sample.is_delta);
      ASSERT_EQ(sample.pdf, bsdf.pdf_specular(sample.direction)) << named.name;
      expect_equal(sample.weight, bsdf.eval_specular(sample.direction) * (std::fabs(sample.direction.z) / sample.pdf), named.name);
    }
  }
}

TEST(Bsdf, DeltaLobesAreMirrorsAndSnells) {
  const Matter glass = test::solid_glass(0);
  const Vec3 o = test::towards(0.6F);
  for (const bool is_front : {true, false}) {
    const Bsdf bsdf = test::bsdf_of(glass, o, is_front);
    ASSERT_TRUE(bsdf.is_delta());
    const Bsdf::Sample mirrored = bsdf.sample_specular(0, {0.5F, 0.5F});
    EXPECT_NEAR(static_cast<double>(length(mirrored.direction - Vec3(-o.x, -o.y, o.z))), 0, 1e-6);
    EXPECT_EQ(bsdf.pdf_specular(mirrored.direction), 0);
    EXPECT_TRUE(is_black(bsdf.eval_specular(mirrored.direction)));
    const Bsdf::Sample bent = bsdf.sample_specular(0.9999F, {0.5F, 0.5F});
    const float eta = is_front ? 1.5F : 1 / 1.5F;
    if (!is_front) {  // sin 0.8 * 1.5 > 1
      EXPECT_GT(bent.direction.z, 0);
      continue;
    }
    EXPECT_LT(bent.direction.z, 0);
    EXPECT_NEAR(static_cast<double>(std::hypot(bent.direction.x, bent.direction.y) * eta), 0.8, 1e-6);
  }
}

// Frequencies of the delta lobes times their weights are the reflectances, whatever the frequencies.
TEST(Bsdf, DeltaLobesAreChosenByTheirWeights) {
  const float cosine = 0.3F;
  const Bsdf bsdf = test::bsdf_of(test::solid_glass(0), test::towards(cosine));
  const test::Albedo albedo = test::sampled_albedo(bsdf);
  const double reflected = static_cast<double>(fresnel_dielectric(cosine, 1.5F));
  EXPECT_NEAR(luminance(albedo.specular_above), reflected, 1e-3);
  EXPECT_NEAR(luminance(albedo.specular_below), 1 - reflected, 1e-3);
}

TEST(Bsdf, LambertianMatterIsExact) {
  Matter m;
  m.base = {0.2F, 0.4F, 0.8F};
  const Bsdf bsdf = test::bsdf_of(m, test::towards(0.3F));
  EXPECT_FALSE(bsdf.has_specular());
  EXPECT_EQ(bsdf.diffuse_reflectance(), m.base);
  EXPECT_EQ(bsdf.diffuse_shape(test::towards(0.1F)), 1);
  EXPECT_EQ(bsdf.eval_diffuse(test::towards(0.1F)), m.base * kInversePi);
  EXPECT_TRUE(is_black(bsdf.eval_diffuse({0, 0, -1})));
  EXPECT_EQ(reflectance(m, 0.2F), m.base);
  EXPECT_EQ(mean_reflectance(m), m.base);
}

}  // namespace
}  // namespace radfarm
