#include "matter/bsdf.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "base/random.h"
#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

template <std::size_t N>
float one_of(RandomSequence& random, const std::array<float, N>& values) {
  return values[static_cast<std::size_t>(random.uniform() * static_cast<float>(N))];
}

/// Any combination of parameters at the ends of their ranges and about the thresholds.
Matter random_matter(RandomSequence& random) {
  constexpr std::array kShares = {0.0F, 0.0F, 1.0F, 1.0F, 0.5F, 1e-6F, 0.999999F};
  constexpr std::array kRoughnesses = {0.0F, 1e-4F, 0.0316F, 0.03162277F, 0.0317F, 0.05F, 0.3F, 0.999F, 1.0F};
  Matter m;
  m.base = {one_of(random, kShares), one_of(random, kShares), one_of(random, kShares)};
  m.metallic = one_of(random, kShares);
  m.roughness = one_of(random, kRoughnesses);
  m.specular = one_of(random, kShares);
  m.specular_color = Spectrum(one_of(random, std::array{1.0F, 0.0F, 0.5F, 10.0F}));
  m.ior = one_of(random, std::array{1.0F, 1.0001F, 1.001F, 1.01F, 1.5F, 2.5F, 100.0F});
  m.transmission = one_of(random, kShares);
  m.has_volume = random.uniform() < 0.5F;
  m.clearcoat = one_of(random, kShares);
  m.clearcoat_roughness = one_of(random, kRoughnesses);
  m.sheen = Spectrum(one_of(random, kShares));
  m.sheen_roughness = one_of(random, kRoughnesses);
  m.anisotropy = one_of(random, kShares);
  m.anisotropy_rotation = 6 * random.uniform();
  return m;
}

Vec3 random_direction(RandomSequence& random) {
  constexpr std::array kCosines = {1.0F, 0.5F, 0.1F, 1e-2F, 1e-4F, 1e-6F, 1e-7F, 1e-20F, 0.0F};
  const float cosine = random.uniform() < 0.5F ? random.uniform() : one_of(random, kCosines);
  return test::towards(cosine, 6.3F * random.uniform());
}

bool is_light(const Spectrum& s) { return is_finite(s) && min_component(s) >= 0; }

::testing::AssertionResult is_sound(const Bsdf& bsdf, const Vec3& i) {
  const Spectrum diffuse = bsdf.eval_diffuse(i), specular = bsdf.eval_specular(i);
  const float pdf = bsdf.pdf_specular(i), shape = bsdf.diffuse_shape(i);
  if (is_light(diffuse) && is_light(specular) && std::isfinite(pdf) && pdf >= 0 && std::isfinite(shape) && shape >= 0) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "diffuse " << diffuse.r << " specular " << specular.r << ' ' << specular.g << " pdf "
                                       << pdf << " shape " << shape;
}

std::string text(const Matter& m) {
  std::ostringstream out;
  out << "base " << m.base.r << ' ' << m.base.g << " metallic " << m.metallic << " roughness " << m.roughness << " specular "
      << m.specular << " x " << m.specular_color.r << " ior " << m.ior << " transmission " << m.transmission << " volume "
      << m.has_volume << " coat " << m.clearcoat << " r " << m.clearcoat_roughness << " sheen " << m.sheen.r << " r "
      << m.sheen_roughness << " anisotropy " << m.anisotropy;
  return out.str();
}

TEST(BsdfHardCases, NothingIsNanInfiniteOrNegative) {
  RandomSequence random(31);
  for (int k = 0; k < 400'000; ++k) {
    const Matter m = random_matter(random);
    const Vec3 o = random_direction(random);
    const Bsdf bsdf(m, Frame(Vec3(0, 0, 1)), o, random.uniform() < 0.5F);
    const Vec3 i = random_direction(random);
    for (const Vec3& direction : {i, -i, o, -o, Vec3(-o.x, -o.y, o.z)}) {
      ASSERT_TRUE(is_sound(bsdf, direction)) << text(m) << " o.z " << o.z << " i.z " << direction.z;
    }
    for (int s = 0; s < 2; ++s) {
      const float choice = random.uniform(), u = one_of(random, std::array{0.0F, 0x1.fffffep-1F, 0.3F, random.uniform()});
      const Bsdf::Sample sample = bsdf.sample_specular(choice, {u, random.uniform()});
      ASSERT_TRUE(is_light(sample.weight) && is_finite(sample.direction) && std::isfinite(sample.pdf) && sample.pdf >= 0)
          << text(m) << " o.z " << o.z << " weight " << sample.weight.r << " pdf " << sample.pdf;
      ASSERT_NEAR(static_cast<double>(length(sample.direction)), 1, 1e-4) << text(m);
      if (is_black(sample.weight) || sample.is_delta) continue;
      ASSERT_TRUE(is_sound(bsdf, sample.direction)) << text(m) << " o.z " << o.z << " i.z " << sample.direction.z;
    }
    const Spectrum passes = pane_passage(m, std::fabs(o.z)), reflects = reflectance(m, std::fabs(o.z));
    ASSERT_TRUE(is_light(passes) && is_light(reflects) && is_light(bsdf.specular_albedo()) && is_light(bsdf.diffuse_reflectance()))
        << text(m);
    ASSERT_LE(max_component(reflects), 1) << text(m);
  }
}

// 4096 points with weights of at most a few know a mean to about 1 %: a breach of 0.5 % is looked at again, with 2^18.
TEST(BsdfHardCases, NoMatterGivesMoreThanItGets) {
  RandomSequence random(37);
  for (int k = 0; k < 4'000; ++k) {
    const Matter m = random_matter(random);
    const Vec3 o = random_direction(random);
    const bool is_front = random.uniform() < 0.5F;
    const Bsdf bsdf(m, Frame(Vec3(0, 0, 1)), o, is_front);
    const double passes = static_cast<double>(max_component(pane_passage(m, std::fabs(o.z))));
    double albedo = max_component(test::sampled_albedo(bsdf, 1 << 10).all());
    if (albedo + passes > 1.005) albedo = max_component(test::sampled_albedo(bsdf, 1 << 18).all());
    // Within half a degree of grazing the tables' entries are further apart than what they hold changes.
    ASSERT_LE(albedo + passes, o.z < 0.01F ? 1.02 : 1.005) << text(m) << " o.z " << o.z << " front " << is_front;
  }
}

}  // namespace
}  // namespace radfarm
