#include "scene/ray_caster.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/random.h"
#include "matter/fresnel.h"
#include "scene/world.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

// A handful of float roundings of numbers up to 1.
constexpr float kRounding = 16 * 0x1p-24F;

/// A square of 8 x 8 m across z. Rays keep off its diagonal: there both triangles are met.
void add_square(test::SceneMaker& maker, std::uint32_t material, float z) {
  maker.polygon(material, {{-4, -4, z}, {4, -4, z}, {4, 4, z}, {-4, 4, z}});
}

/// Glass of material 0 at z = 0, a wall of material 1 at z = -2.
Scene glazed_wall(const Spectrum& color) {
  test::SceneMaker maker;
  const std::uint32_t glass = maker.material(color), wall = maker.material(Spectrum(0.5F));
  add_square(maker, glass, 0);
  add_square(maker, wall, -2);
  Scene scene = maker.take();
  Material& m = scene.materials[glass];
  m.transmission = m.specular = 1;
  m.roughness = 0;
  return scene;
}

Spectrum through(const World& world, float cosine) {
  const float tangent = std::sqrt(1 - cosine * cosine) / cosine;
  return world.caster.transmittance({-tangent / 2, 0.1F, 0.5F}, {tangent / 2, 0.1F, -0.5F});
}

TEST(Panes, PassWhatALosslessPanePasses) {
  const World world(glazed_wall(Spectrum(1.0F)));
  ASSERT_TRUE(world.surfaces.is_pane(0) && world.surfaces.lets_through(0));
  ASSERT_FALSE(world.surfaces.is_pane(1) || world.surfaces.lets_through(1));
  // O17: 2 n / (n^2 + 1) at normal incidence.
  EXPECT_NEAR(through(world, 1).g, 3 / 3.25, kRounding);
  for (const float cosine : {0.9F, 0.7F, 0.5F, 0.3F, 0.2F}) {
    const Spectrum passed = through(world, cosine);
    EXPECT_NEAR(passed.g, pane_transmittance(cosine, 1.5F), 8 * kRounding) << cosine;
    EXPECT_EQ(passed.r, passed.g);
    EXPECT_EQ(passed.b, passed.g);
  }
}

TEST(Panes, PassTheSameFromEitherSideAndThroughAMirroredInstance) {
  Scene scene = glazed_wall(Spectrum(1.0F));
  scene.instances[0].to_world[0][0] = -1;
  const World world(scene), plain(glazed_wall(Spectrum(1.0F)));
  const Vec3 a(0.3F, 0.1F, 0.5F), b(-0.2F, 0.4F, -0.5F);
  EXPECT_NEAR(plain.caster.transmittance(b, a).g, plain.caster.transmittance(a, b).g, kRounding);
  EXPECT_NEAR(world.caster.transmittance(a, b).g, plain.caster.transmittance(a, b).g, kRounding);
}

TEST(Panes, TintByTheirColour) {
  const World world(glazed_wall({0.25F, 0.5F, 1}));
  const Spectrum passed = through(world, 0.8F);
  const float clear = pane_transmittance(0.8F, 1.5F);
  EXPECT_NEAR(passed.r, 0.25F * clear, kRounding);
  EXPECT_NEAR(passed.g, 0.5F * clear, kRounding);
  EXPECT_NEAR(passed.b, clear, 8 * kRounding);
}

TEST(Panes, OneAfterTheOtherMultiply) {
  Scene scene = glazed_wall({0.25F, 0.5F, 1});
  Instance second = scene.instances[0];
  second.to_world[3][2] = 0.25F;  // used twice: instanced
  scene.instances.push_back(second);
  const World world(scene);
  const Spectrum one = through(World(glazed_wall({0.25F, 0.5F, 1})), 0.8F), two = through(world, 0.8F);
  EXPECT_NEAR(two.r, one.r * one.r, kRounding);
  EXPECT_NEAR(two.b, one.b * one.b, 8 * kRounding);
}

TEST(Panes, AreNoneWhereTheyAreRoughSolidOrMetal) {
  const auto is_pane = [](void (*change)(Material&)) {
    Scene scene = glazed_wall(Spectrum(1.0F));
    change(scene.materials[0]);
    return Surfaces(scene).is_pane(0);
  };
  EXPECT_TRUE(is_pane([](Material&) {}));
  EXPECT_FALSE(is_pane([](Material& m) { m.roughness = 0.1F; }));
  EXPECT_FALSE(is_pane([](Material& m) { m.has_volume = true; }));
  EXPECT_FALSE(is_pane([](Material& m) { m.metallic = 1; }));
  EXPECT_FALSE(is_pane([](Material& m) { m.transmission = 0; }));
}

TEST(Panes, OfPartialCoveragePassTheRestUntouched) {
  Scene scene = glazed_wall({0.5F, 0.5F, 0.5F});
  scene.materials[0].alpha_mode = Material::Alpha::kBlend;
  scene.materials[0].alpha = 0.25F;
  const World world(scene);
  EXPECT_NEAR(through(world, 0.8F).g, 0.75F + 0.25F * 0.5F * pane_transmittance(0.8F, 1.5F), kRounding);
}

TEST(Closest, APaneBehindAWallDoesNotTint) {
  const World world(glazed_wall({0.25F, 0.5F, 1}));
  for (std::uint64_t key = 0; key < 200; ++key) {
    // From behind, the wall is met first.
    const auto hit = world.caster.closest({{0.3F, 0.1F, -4}, {0, 0, 1}}, key);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->instance, 1U);
    EXPECT_EQ(hit->weight, Spectrum(1.0F));
  }
}

TEST(Closest, BringsTheColourOfThePaneToWhatItMeetsOrToTheSky) {
  const World world(glazed_wall({0.25F, 0.5F, 1}));
  int passed_on = 0;
  for (std::uint64_t key = 0; key < 200; ++key) {
    const auto hit = world.caster.closest({{0.3F, 0.1F, 2}, {0, 0, -1}}, key);
    ASSERT_TRUE(hit);
    if (hit->instance == 0) continue;
    ++passed_on;
    EXPECT_NEAR(hit->weight.r, 0.25F, kRounding);
    EXPECT_NEAR(hit->weight.g, 0.5F, kRounding);
    EXPECT_NEAR(hit->weight.b, 1, kRounding);
    Spectrum passed(1.0F);
    const auto short_ray = world.caster.closest({{0.3F, 0.1F, 2}, {0, 0, -1}}, key, 3, &passed);
    EXPECT_FALSE(short_ray);
    EXPECT_EQ(passed, hit->weight);
  }
  EXPECT_GT(passed_on, 0);
}

TEST(Closest, DecidesByKeyAlone) {
  const World world(glazed_wall(Spectrum(1.0F)));
  for (std::uint64_t key = 0; key < 100; ++key) {
    const Ray ray{{0.2F, 0.1F, 2}, {0, 0, -1}};
    EXPECT_EQ(world.caster.closest(ray, key)->instance, world.caster.closest(ray, key)->instance);
  }
}

TEST(Closest, ReachesNoFurtherThanAsked) {
  const World world(glazed_wall(Spectrum(1.0F)));
  EXPECT_FALSE(world.caster.closest({{0.3F, 0.1F, -1}, {0, 0, -1}}, 1, 0.5F));
  EXPECT_TRUE(world.caster.closest({{0.3F, 0.1F, -1}, {0, 0, -1}}, 1, 1.5F));
}

}  // namespace
}  // namespace radfarm
