#include "paths/photon_path.h"

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using test::SceneMaker;

std::vector<Segment> segments_of(const World& world, std::uint64_t index) {
  std::vector<Segment> all;
  follow_path(world, 7, index, [&](const Segment& s) { all.push_back(s); });
  return all;
}

Scene furnace(const Spectrum& reflectance) {
  SceneMaker maker;
  const auto grey = maker.material(reflectance);
  const auto lamp = maker.material(Spectrum(0.0F), Spectrum(10.0F));
  maker.room(std::vector<std::uint32_t>(6, grey), {-2, -2, -2}, {2, 2, 2});
  maker.polygon(lamp, {{-.5F, 1.9F, -.5F}, {.5F, 1.9F, -.5F}, {.5F, 1.9F, .5F}, {-.5F, 1.9F, .5F}});
  return maker.take();
}

TEST(PhotonPath, LuminanceIsTheSameAlongThePath) {
  const World world(furnace({.9F, .4F, .1F}));
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto segments = segments_of(world, i);
    for (const Segment& s : segments) {
      EXPECT_NEAR(luminance(s.power), luminance(segments[0].power), 1e-4F * luminance(segments[0].power));
      EXPECT_EQ(s.origin, s.bounce == 0 ? Origin::kEmitter : Origin::kDiffuse);
    }
  }
}

TEST(PhotonPath, MeetsAsManySurfacesAsReflectanceSays) {  // O9: 1 / (1 - rho)
  const World world(furnace(Spectrum(.8F)));
  double hits = 0;
  constexpr int kPaths = 20000;
  for (std::uint64_t i = 0; i < kPaths; ++i) hits += static_cast<double>(segments_of(world, i).size());
  // The lamp absorbs a little: less than its share of the area on each hit.
  EXPECT_LT(hits / kPaths, 5.2);
  EXPECT_GT(hits / kPaths, 4.5);
}

TEST(PhotonPath, PowerThatLeavesIsAbsorbedOrEscapes) {
  SceneMaker maker;
  const auto grey = maker.material({.6F, .5F, .3F});
  const auto lamp = maker.material(Spectrum(0.0F), Spectrum(10.0F));
  maker.polygon(grey, {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}});
  maker.polygon(lamp, {{-.5F, 1.9F, -.5F}, {.5F, 1.9F, -.5F}, {.5F, 1.9F, .5F}, {-.5F, 1.9F, .5F}});
  const World world(maker.take());
  double lost = 0;
  constexpr int kPaths = 4096;
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    const PathLosses one = follow_path(world, 3, i, [](const Segment&) {});
    lost += one.absorbed + one.escaped;
  }
  EXPECT_NEAR(lost / kPaths, world.emitters.total_flux, 1e-3 * world.emitters.total_flux);
}

TEST(PhotonPath, AMirrorsLightIsSpecularAndAPanesIsItsSources) {
  SceneMaker maker;
  Scene scene = [&] {
    const auto mirror = maker.material(Spectrum(1.0F));
    const auto pane = maker.material(Spectrum(1.0F));
    const auto grey = maker.material(Spectrum(.5F));
    maker.polygon(mirror, {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}});
    maker.polygon(pane, {{-2, .5F, -2}, {-2, .5F, 2}, {2, .5F, 2}, {2, .5F, -2}});
    maker.polygon(grey, {{-9, 9, -9}, {9, 9, -9}, {9, 9, 9}, {-9, 9, 9}});
    PunctualLight spot;
    spot.kind = PunctualLight::Kind::kSpot;
    spot.position = {0, 3, 0};
    spot.direction = {0, -1, 0};
    spot.cos_inner = .99F, spot.cos_outer = .98F;
    spot.intensity = Spectrum(100.0F);
    maker.light(spot);
    return maker.take();
  }();
  scene.materials[0].metallic = 1, scene.materials[0].roughness = 0;
  scene.materials[1].transmission = 1, scene.materials[1].roughness = 0;
  const World world(std::move(scene));
  int through = 0, mirrored = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    for (const Segment& s : segments_of(world, i)) {
      if (s.begin > 0 && s.ray.direction.y < 0 && s.bounce == 1) {
        EXPECT_EQ(s.origin, Origin::kEmitter);  // the lamp's light, by the window
        ++through;
      }
      if (s.ray.direction.y > 0 && s.bounce == 2) {
        EXPECT_EQ(s.origin, Origin::kSpecular);
        ++mirrored;
      }
    }
  }
  EXPECT_GT(through, 20);
  EXPECT_GT(mirrored, 20);
}

}  // namespace
}  // namespace radfarm
