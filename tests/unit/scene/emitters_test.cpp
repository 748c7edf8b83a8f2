#include "scene/emitters.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

Emitters emitters_of(const Scene& scene) {
  return find_emitters(Surfaces(scene), EnvironmentLight(scene.environment), 1);
}

/// A triangle, lit by a spot light whose cone is a line.
Scene scene_with_needle_spot() {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Scene scene = maker.take();
  PunctualLight needle;
  needle.kind = PunctualLight::Kind::kSpot;
  needle.intensity = Spectrum(1);
  needle.cos_outer = 1;
  scene.lights.push_back(needle);
  return scene;
}

TEST(Emitters, WithoutFluxAreChosenEvenly) {
  const Scene scene = scene_with_needle_spot();
  const Emitters emitters = emitters_of(scene);
  EXPECT_EQ(emitters.total_flux, 0);
  ASSERT_EQ(emitters.choice.size(), 1U);
  EXPECT_EQ(emitters.choice.probability(0), 1);
}

TEST(Emitters, OfAMaterialSwitchedOffAreDeclaredButGiveNothing) {
  Scene scene = scene_with_needle_spot();
  EXPECT_EQ(emitters_of(scene).declared_triangles, 0U);
  scene.materials[0].is_switched_off = true;
  const Emitters emitters = emitters_of(scene);
  EXPECT_EQ(emitters.declared_triangles, 1U);
  EXPECT_TRUE(emitters.triangles.empty());
  EXPECT_EQ(emitters.find(0, 0), kNone);
}

/// A light 3 m above the triangle's plane with 600 cd down and 300 cd at 60 degrees.
Scene scene_with_ies_light() {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Scene scene = maker.take();
  scene.photometries.push_back({"lamp", {0, 60, 90}, {0}, {600, 300, 0}});
  PunctualLight light;
  light.position = {0, 3, 0};
  light.direction = {0, -1, 0};
  light.right = {1, 0, 0};
  light.intensity = Spectrum(2);
  light.photometry = 0;
  scene.lights.push_back(light);
  return scene;
}

TEST(Emitters, OfAPhotometryShineByItsTable) {
  const Scene scene = scene_with_ies_light();
  const Emitters emitters = emitters_of(scene);
  ASSERT_EQ(emitters.punctual.size(), 1U);
  EXPECT_NEAR(emitters.total_flux, 2 * zonal_lumens(scene.photometries[0]), 1e-6 * emitters.total_flux);
  const PunctualArrival below = arrive(emitters.punctual[0], {0, 0, 0}, 1);
  EXPECT_NEAR(below.irradiance.g, 1200.0F / 9, 1e-4F);
  EXPECT_EQ(below.direction, Vec3(0, 1, 0));
  // At 60 degrees the distance is 6 m.
  const PunctualArrival aside = arrive(emitters.punctual[0], {0, 0, 3 * std::sqrt(3.0F)}, 1);
  EXPECT_NEAR(aside.irradiance.g, 600.0F / 36, 1e-4F);
  EXPECT_TRUE(is_black(arrive(emitters.punctual[0], {1, 4, 0}, 1).irradiance));
}

TEST(Emitters, OfABlackPhotometryGiveNothing) {
  Scene scene = scene_with_ies_light();
  scene.photometries[0].candela = {0, 0, 0};
  EXPECT_TRUE(emitters_of(scene).punctual.empty());
}

}  // namespace
}  // namespace radfarm
