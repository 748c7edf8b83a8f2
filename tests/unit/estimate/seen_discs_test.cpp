#include "estimate/seen_discs.h"

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

/// A floor of reflectance .5, seen straight from 2 m above; `with_step`: one half of it is a metre higher.
Scene floor(bool with_step) {
  test::SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F));
  const auto lamp = maker.material(Spectrum(0.0F), Spectrum(1.0F));
  maker.polygon(grey, {{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}});
  if (with_step) maker.polygon(grey, {{0, 1, -4}, {0, 1, 4}, {4, 1, 4}, {4, 1, -4}});
  maker.polygon(lamp, {{-4, 9, -4}, {4, 9, -4}, {4, 9, 4}, {-4, 9, 4}});
  return maker.take();
}

Film film_above(float fov = 1) {
  const Camera camera = *place_camera({0, 2, 0}, {0, 0, 0}, {0, 0, -1}, fov);
  return {camera, 9, 9, 1, 0};
}

TEST(SeenDiscs, APixelThatSeesOneSurfaceHasOneDisc) {
  const World world(floor(false));
  const Components components(world.scene);
  const SeenDiscs seen = see_discs(world, components, film_above(), {8, 1000, .1F, 100});
  ASSERT_EQ(seen.discs.size(), 81U);
  for (std::size_t i = 0; i < seen.discs.size(); ++i) {
    EXPECT_EQ(seen.shown[i].pixel, i);
    EXPECT_NEAR(seen.shown[i].weight.g, .5F * kInversePi, 1e-6F);  // rho / pi, all samples together
    EXPECT_EQ(seen.discs[i].shape.radius, .1F);
  }
}

TEST(SeenDiscs, APixelOnAnEdgeHasOneForEachSurface) {
  const World world(floor(true));
  const Components components(world.scene);
  const SeenDiscs seen = see_discs(world, components, film_above(), {16, 1000, .1F, 100});
  EXPECT_EQ(seen.discs.size(), 90U);  // nine pixels of the middle column
  std::vector<float> weights(81);
  for (const ShownDisc& shown : seen.shown) weights[shown.pixel] += shown.weight.g;
  for (const float weight : weights) EXPECT_NEAR(weight, .5F * kInversePi, 1e-6F);
}

TEST(SeenDiscs, RadiiFollowTheLight) {
  const World world(floor(false));
  const Components components(world.scene);
  const SeenDiscs few = see_discs(world, components, film_above(.05F), {4, 200000, 0, 100});
  const SeenDiscs many = see_discs(world, components, film_above(.05F), {4, 3200000, 0, 100});
  // Sixteen times the paths need a quarter of the radius for as many crossings, but for the pilots' noise.
  double ratio = 0;
  for (std::size_t i = 0; i < 81; ++i)
    ratio += static_cast<double>(many.discs[i].shape.radius / few.discs[i].shape.radius) / 81;
  EXPECT_NEAR(ratio, .25, .08);
}

}  // namespace
}  // namespace radfarm
