#include "paths/photon_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "paths/density.h"
#include "paths/radius.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

/// Photons all over a unit cube, a third of them on surfaces that face down.
std::vector<Photon> scattered(std::uint64_t count) {
  std::vector<Photon> photons;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto number = [&](std::uint64_t axis) { return static_cast<float>(combine(7, axis, i) >> 40) / 0x1p24F; };
    photons.push_back({{number(0), number(1), number(2)}, {0, i % 3 == 0 ? -1.0F : 1.0F, 0}, Spectrum(1.0F)});
  }
  return photons;
}

/// Squared distances of the photons that count, nearest first.
std::vector<float> squares(const std::vector<Photon>& photons, const OrientedDisc& disc) {
  std::vector<float> all;
  for (const Photon& p : photons) {
    const float square = (p.position - disc.centre).length2();
    if (dot(p.normal, disc.normal) > 0 && square < disc.radius * disc.radius) all.push_back(square);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(PhotonMap, FindsWhatATestOfAllFinds) {
  const std::vector<Photon> photons = scattered(5000);
  const PhotonMap map(photons);
  for (const float radius : {.02F, .2F, 3.0F}) {
    const OrientedDisc disc{{.4F, .6F, .5F}, {0, 1, 0}, radius};
    const std::vector<float> truth = squares(photons, disc);
    std::vector<float> found;
    map.each_near(disc, [&](const Photon& p) { found.push_back((p.position - disc.centre).length2()); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, truth);
    for (const std::size_t count : {1U, 12U, 300U}) {
      const float expected = truth.size() >= count ? std::sqrt(truth[count - 1]) : radius;
      EXPECT_EQ(map.distance_of(count, disc), expected) << count;
    }
  }
}

TEST(PhotonMap, AnEmptyMapHasNoPhotons) {
  const PhotonMap map({});
  const OrientedDisc disc{{0, 0, 0}, {0, 1, 0}, 2};
  map.each_near(disc, [](const Photon&) { FAIL(); });
  EXPECT_EQ(map.distance_of(1, disc), 2);
}

struct Estimate {
  double map = 0, paths = 0;
  double error = 0;  // standard, of independent photons
};

/// Irradiance at what a vertical ray from `above` meets, by the photons of as many paths, and by the paths themselves.
Estimate estimate(const Scene& scene, const Vec3& above, float radius, std::uint64_t paths) {
  const World world(scene);
  const Components components(world.scene);
  const auto hit = world.caster.closest({above, {0, -1, 0}}, 0);
  SurfacePoint point = world.surfaces.at(*hit);
  face(point, {0, 1, 0});
  const Disc disc = disc_at(point, components.of(hit->instance, hit->triangle), radius);
  const double scale =
      1 / (kPiD * static_cast<double>(radius) * static_cast<double>(radius) * static_cast<double>(paths));
  Estimate result;
  double squared = 0;
  PhotonMap(photons_of(world, kAllOrigins, {1, 0, paths})).each_near(disc.shape, [&](const Photon& p) {
    const double power = static_cast<double>(luminance(p.power)) * scale;
    result.map += power;
    squared += power * power;
  });
  result.error = std::sqrt(squared);
  const DiscSet set(world, components, {disc});
  std::vector<DiscSums> sums(1);
  add_batch(world, set, kAllOrigins, {1, 0, paths}, sums);
  result.paths = luminance(sums[0].flux) / static_cast<double>(paths);
  return result;
}

void add_floor(test::SceneMaker& maker, float x0, float x1, float height) {
  const auto grey = maker.material(Spectrum(0.0F));
  maker.polygon(grey, {{x0, height, -2}, {x0, height, 2}, {x1, height, 2}, {x1, height, -2}});
}

PunctualLight sun() {
  PunctualLight light;
  light.kind = PunctualLight::Kind::kDirectional;
  light.direction = {0, -1, 0};
  light.intensity = Spectrum(100.0F);
  return light;
}

TEST(PhotonMap, IsRightOnAFlatFloor) {
  test::SceneMaker maker;
  add_floor(maker, -2, 2, 0);
  PunctualLight lamp;
  lamp.position = {0, 1, 0};
  lamp.intensity = Spectrum(100.0F);
  const Estimate e = estimate(maker.light(lamp).take(), {0, .5F, 0}, .2F, 200000);
  // The mean over a disc about the foot of the perpendicular: the flux of the cone, 2 pi I (1 - cos), over pi r^2.
  const double truth = 2 * kPiD * 100 * (1 - 1 / std::hypot(1, .2)) / (kPiD * .04);
  EXPECT_NEAR(e.map, truth, 5 * e.error);
  EXPECT_NEAR(e.paths, e.map, 1e-3 * truth);  // they are the same photons
}

TEST(PhotonMap, DarkensEdgesWherePathsDoNot) {
  test::SceneMaker maker;
  add_floor(maker, -1, 0, 1);
  add_floor(maker, -3, 3, 0);
  const Estimate e = estimate(maker.light(sun()).take(), {-.001F, 2, 0}, .1F, 300000);
  EXPECT_NEAR(e.map, 50, 5 * e.error + 1);  // half of the ball has no floor
  EXPECT_NEAR(e.paths, 100, 10 * e.error);
}

TEST(PhotonMap, MissesShadowsOfWhatIsNear) {
  test::SceneMaker maker;
  add_floor(maker, -2, 2, 0);
  add_floor(maker, -.5F, .5F, .03F);
  const Estimate e = estimate(maker.light(sun()).take(), {0, .02F, 0}, .2F, 300000);
  EXPECT_NEAR(e.map, 100 * (1 - .03 * .03 / .04), 5 * e.error);  // what lies on the blocker
  EXPECT_LT(e.paths, 5);
}

TEST(PhotonMap, RadiiHoldAsManyPhotonsAsWereAskedFor) {
  test::SceneMaker maker;
  add_floor(maker, -2, 2, 0);
  const World world(maker.light(sun()).take());
  const Components components(world.scene);
  std::vector<Disc> discs;
  for (float x = -1; x < 1; x += .1F) discs.push_back(disc_in_air({x, 0, x / 2}, {0, 1, 0}, 1));
  const std::vector<float> least(discs.size(), 1e-6F);
  const PathBatch paths{1, 0, 200000};
  const std::vector<float> radii = radii_by_nearest(world, discs, kAllOrigins, paths, 200, least, 1);
  const PhotonMap map(photons_of(world, kAllOrigins, paths));
  double mean = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    discs[i].shape.radius = radii[i];
    map.each_near(discs[i].shape, [&](const Photon&) { mean += 1 / static_cast<double>(discs.size()); });
  }
  // Each by 12 photons of a pilot: 200 (1 +- 1 / sqrt(12)), and 20 of them.
  EXPECT_NEAR(mean, 200, 5 * 200 / std::sqrt(12 * 20.0));
}

}  // namespace
}  // namespace radfarm
