#include "scene/emitters.h"

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

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
  const Emitters emitters = find_emitters(Surfaces(scene), 1);
  EXPECT_EQ(emitters.total_flux, 0);
  ASSERT_EQ(emitters.choice.size(), 1U);
  EXPECT_EQ(emitters.choice.probability(0), 1);
}

TEST(Emitters, OfAMaterialSwitchedOffAreDeclaredButGiveNothing) {
  Scene scene = scene_with_needle_spot();
  EXPECT_EQ(find_emitters(Surfaces(scene), 1).declared_triangles, 0U);
  scene.materials[0].is_switched_off = true;
  const Emitters emitters = find_emitters(Surfaces(scene), 1);
  EXPECT_EQ(emitters.declared_triangles, 1U);
  EXPECT_TRUE(emitters.triangles.empty());
  EXPECT_EQ(emitters.find(0, 0), kNone);
}

}  // namespace
}  // namespace radfarm
