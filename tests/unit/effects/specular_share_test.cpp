#include "effects/specular_share.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

Material with(float metallic, float specular, float roughness) {
  Material m;
  m.metallic = metallic, m.specular = specular, m.roughness = roughness;
  return m;
}

TEST(IsSharp, AsksForALobeAndItsWidth) {
  Scene scene;
  EXPECT_FALSE(is_sharp(scene, with(0, 0, 0))) << "no lobe";
  EXPECT_TRUE(is_sharp(scene, with(1, 0, .2F)));
  EXPECT_FALSE(is_sharp(scene, with(1, 0, .6F)));
  EXPECT_TRUE(is_sharp(scene, with(0, 1, .3F)));
  Material varnished = with(0, 0, 1);
  varnished.clearcoat = 1;
  EXPECT_TRUE(is_sharp(scene, varnished));
  Material glass = with(0, 0, 0);
  glass.transmission = 1;
  EXPECT_TRUE(is_sharp(scene, glass));
}

TEST(IsSharp, CountsTexturesWithTheirMean) {
  Scene scene;
  scene.textures.push_back({2, 1, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {{0, 0, 0, 255}, {0, 102, 0, 255}}});
  Material metal = with(1, 0, 1);
  EXPECT_FALSE(is_sharp(scene, metal));
  metal.metallic_roughness_texture.texture = 0;
  EXPECT_TRUE(is_sharp(scene, metal)) << "a mean of .2";
}

TEST(SpecularShares, OfDiffuseScenesAreExactlyNothing) {
  const World world(test::own_scene("cornell"));
  const SpecularShares shares = measure_specular_shares(world, 1);
  EXPECT_EQ(shares.sharp.share, 0);
  EXPECT_EQ(shares.sharp.at_most, 0);
  EXPECT_EQ(shares.rough.at_most, 0);
}

TEST(SpecularShares, AreOfTheLightThatDiffuseSurfacesReflect) {
  // effects/glowing_box: 4 of 24 m^2 are a mirror that sends all it has, 8 pi lm, to walls that receive 40 pi.
  const World world(test::own_scene("effects/glowing_box"));
  const SpecularShares shares = measure_specular_shares(world, 1);
  EXPECT_NEAR(shares.sharp.share, 0.2, 0.01);
  EXPECT_GT(shares.sharp.at_most, shares.sharp.share);
  EXPECT_LT(shares.sharp.at_most, 0.21);
  EXPECT_EQ(shares.rough.at_most, 0);
}

TEST(SpecularShares, AreBoundedWhereNoPathShowedAny) {
  // A mirror that no light reaches.
  Scene scene = test::own_scene("furnace");
  Mesh hidden = scene.meshes[0];
  for (Vec3& p : hidden.positions) p = p * 3.0F;  // around the closed box
  hidden.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(with(1, 0, 0));
  scene.meshes.push_back(hidden);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  scene.instances.push_back(instance);
  const World world(std::move(scene));
  const SpecularShares shares = measure_specular_shares(world, 1);
  EXPECT_EQ(shares.sharp.share, 0);
  EXPECT_GT(shares.sharp.at_most, 0);
  EXPECT_LT(shares.sharp.at_most, 1e-3);
}

TEST(SpecularShares, KnowWhatPanesReflect) {
  // A lamp over a pane over a floor: the first surface of every path is the pane, and some of them go back up.
  test::SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F)), pane = maker.material(Spectrum(1.0F));
  const auto lamp = maker.material(Spectrum(0.0F), Spectrum(10.0F));
  maker.polygon(grey, {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  maker.polygon(pane, {{-9, 1, -9}, {-9, 1, 9}, {9, 1, 9}, {9, 1, -9}});
  maker.polygon(grey, {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}});
  maker.polygon(lamp, {{-.2F, 2, -.2F}, {.2F, 2, -.2F}, {.2F, 2, .2F}, {-.2F, 2, .2F}});
  Scene scene = maker.take();
  scene.materials[1].transmission = 1, scene.materials[1].roughness = 0, scene.materials[1].specular = 1;
  const World world(std::move(scene));
  const SpecularShares shares = measure_specular_shares(world, 1);
  EXPECT_GT(shares.sharp.share, 0.05);
  EXPECT_LT(shares.sharp.share, 0.8);
  EXPECT_EQ(shares.rough.at_most, 0);
}

TEST(SpecularShares, HaveTheSameBitsForAnyNumberOfThreads) {
  const World world(test::own_scene("effects/glass_sphere"));
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return measure_specular_shares(world, 3).sharp.share;
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

}  // namespace
}  // namespace radfarm
