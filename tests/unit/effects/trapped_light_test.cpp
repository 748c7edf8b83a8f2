#include "effects/trapped_light.h"

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

using test::SceneMaker;

std::optional<TrappedLight> trapped_in(SceneMaker& maker) { return find_trapped_light(World(maker.take()), 1); }

SceneMaker& box(SceneMaker& maker, std::uint32_t material, float low, float high) {
  return maker.room(std::vector<std::uint32_t>(6, material), Vec3(low), Vec3(high));
}

TEST(TrappedLight, AClosedRoomThatReflectsEverythingTrapsIt) {
  SceneMaker maker;
  box(maker, maker.material(Spectrum(1.0F), Spectrum(2.0F)), 0, 1);
  const auto trapped = trapped_in(maker);
  ASSERT_TRUE(trapped);
  EXPECT_EQ(trapped->emitter, 0U);
  EXPECT_EQ(trapped->channel, 0U);
}

TEST(TrappedLight, OneDarkSurfaceOrAnOpeningSetsItFree) {
  SceneMaker dark;
  const std::uint32_t white = dark.material(Spectrum(1.0F), Spectrum(1.0F)), grey = dark.material(Spectrum(0.5F));
  dark.room({white, white, grey, white, white, white}, Vec3(0.0F), Vec3(1.0F));
  EXPECT_FALSE(trapped_in(dark));
  SceneMaker open;  // one percent of a wall is missing
  const std::uint32_t m = open.material(Spectrum(1.0F), Spectrum(1.0F));
  open.room({m, m, m, m, m, m}, Vec3(0.0F), Vec3(1.0F));
  Scene scene = open.take();
  scene.meshes[0].positions = {{0, 0, 0}, {0, 0, 0.99F}, {1, 0, 0.99F}, {1, 0, 0}};
  EXPECT_FALSE(find_trapped_light(World(std::move(scene)), 1));
}

TEST(TrappedLight, OnlyWhatTheLightReachesCounts) {
  // A white box with a lamp inside, within a grey room; the same box without a lamp lets the room's own light be.
  for (const bool is_lit : {true, false}) {
    SceneMaker maker;
    const std::uint32_t white = maker.material(Spectrum(1.0F));
    const std::uint32_t lamp = maker.material(Spectrum(1.0F), Spectrum(is_lit ? 1.0F : 0.0F));
    const std::uint32_t grey = maker.material(Spectrum(0.5F)), sky = maker.material(Spectrum(0.5F), Spectrum(1.0F));
    maker.room({grey, sky, grey, grey, grey, grey}, Vec3(-2.0F), Vec3(2.0F));
    maker.room({white, lamp, white, white, white, white}, Vec3(0.0F), Vec3(1.0F));
    const auto trapped = trapped_in(maker);
    EXPECT_EQ(trapped.has_value(), is_lit);
    EXPECT_EQ(trapped.value_or(TrappedLight{2}).emitter, 2U) << "after the ceiling's two triangles";
  }
}

TEST(TrappedLight, EachChannelCountsByItself) {
  SceneMaker red;
  box(red, red.material({1, 0.5F, 0.5F}, Spectrum(1.0F)), 0, 1);
  EXPECT_EQ(trapped_in(red)->channel, 0U);
  SceneMaker blue;
  box(blue, blue.material({0.5F, 0.5F, 1}, Spectrum(1.0F)), 0, 1);
  EXPECT_EQ(trapped_in(blue)->channel, 2U);
  SceneMaker unlit;  // nothing shines in the channel that would be trapped
  box(unlit, unlit.material({1, 0.5F, 0.5F}, {0, 1, 1}), 0, 1);
  EXPECT_FALSE(trapped_in(unlit));
  SceneMaker mixed;  // each channel has one surface that takes it
  const std::uint32_t a = mixed.material({1, 1, 0.5F}, Spectrum(1.0F)), b = mixed.material({0.5F, 0.5F, 1});
  mixed.room({a, a, a, b, a, a}, Vec3(0.0F), Vec3(1.0F));
  EXPECT_FALSE(trapped_in(mixed));
}

TEST(TrappedLight, PointLightsAreTrappedAndDirectionsNever) {
  for (const auto kind : {PunctualLight::Kind::kPoint, PunctualLight::Kind::kSpot, PunctualLight::Kind::kDirectional}) {
    SceneMaker maker;
    box(maker, maker.material(Spectrum(1.0F)), -1, 1);
    PunctualLight light;
    light.kind = kind;
    light.intensity = Spectrum(1.0F);
    light.cos_inner = light.cos_outer = 0.5F;
    maker.light(light);
    EXPECT_EQ(trapped_in(maker).has_value(), kind != PunctualLight::Kind::kDirectional);
  }
}

TEST(TrappedLight, ReflectanceJustBelowOneIsNoTrap) {
  SceneMaker maker;
  box(maker, maker.material(Spectrum(0.999F), Spectrum(1.0F)), 0, 1);
  EXPECT_FALSE(trapped_in(maker));
}

TEST(TrappedLight, TheBackOfAnEmitterCountsWhereItShines) {
  // A lamp closes a white box from outside: only its back lights the inside.
  for (const bool both : {true, false}) {
    SceneMaker maker;
    const std::uint32_t white = maker.material(Spectrum(1.0F)), lamp = maker.material(Spectrum(1.0F), Spectrum(1.0F));
    maker.room({white, lamp, white, white, white, white}, Vec3(0.0F), Vec3(1.0F));
    Scene scene = maker.take();
    for (auto& t : scene.meshes[1].triangles) std::swap(t[1], t[2]);
    scene.materials[lamp].emits_from_both_sides = both;
    EXPECT_EQ(find_trapped_light(World(std::move(scene)), 1).has_value(), both);
  }
}

}  // namespace
}  // namespace radfarm
