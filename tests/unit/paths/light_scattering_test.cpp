#include "paths/light_scattering.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

/// A plate seen straight from above.
World plate(const Material& material) {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(.5F)), {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  Scene scene = maker.take();
  scene.materials[0] = material;
  return World(std::move(scene));
}

RunningStatistics sent(const World& world, bool specular_only) {
  const Hit hit = world.surfaces.hit_at(0, 0, {0, 0, 0});
  const LightVertex vertex(world, hit, normalize(Vec3(.3F, 1, .2F)));
  RunningStatistics sum;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    RandomSequence random(combine(1, i));
    const ScatteredLight light =
        scatter_light(vertex, Spectrum(1.0F), {random.uniform(), random.uniform(), {random.uniform(), random.uniform()}});
    sum.add(!specular_only || light.is_specular ? static_cast<double>(luminance(light.weight)) : 0);
  }
  return sum;
}

TEST(ScatterLight, SendsOnWhatTheSurfaceReflects) {
  Material matte;
  matte.base_color = Spectrum(.6F);
  EXPECT_NEAR(sent(plate(matte), false).mean(), .6, 1e-5);
  Material metal;
  metal.base_color = Spectrum(.8F), metal.metallic = 1, metal.roughness = 0;
  EXPECT_NEAR(sent(plate(metal), false).mean(), .8, 1e-3);
  EXPECT_NEAR(sent(plate(metal), true).mean(), .8, 1e-3);
  Material varnish = matte;
  varnish.specular = 1, varnish.roughness = 0;
  const World world = plate(varnish);
  const SurfacePoint point = [&] {
    SurfacePoint p = world.surfaces.at(world.surfaces.hit_at(0, 0, {0, 0, 0}));
    face(p, {0, 1, 0});
    return p;
  }();
  Matter matter = world.surfaces.matter(point);
  matter.folds_specular = true;
  const RunningStatistics all = sent(world, false);
  const float cosine = normalize(Vec3(.3F, 1, .2F)).y;
  EXPECT_NEAR(all.mean(), static_cast<double>(luminance(reflectance(matter, cosine))), 5 * all.standard_error());
  matter.folds_specular = false;
  EXPECT_LT(reflectance(matter, cosine).g, .6F) << "the diffuse part alone, under its layer";
}

}  // namespace
}  // namespace radfarm
