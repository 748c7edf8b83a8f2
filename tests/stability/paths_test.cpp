// H50 to H64 of ALGORITHMS.md 3.4: where density estimation on the tangent plane may break.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "paths/density.h"
#include "support/shapes.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using test::SceneMaker;

constexpr double kPiD = std::numbers::pi;
// A reading is off by more than this many standard errors once in 1.7 million, if it is normal. (docs/testing.md)
constexpr double kSigmas = 5;

struct Reading {
  double irradiance = 0;  // luminance, lux
  double error = 0;       // standard, of independent paths
  std::uint64_t crossings = 0;
};

std::vector<Reading> read(const World& world, std::vector<Disc> discs, std::uint64_t paths,
                          const CrossingRules& rules = {}, OriginSet origins = kAllOrigins, std::uint64_t seed = 1) {
  const Components components(world.scene);
  const DiscSet set(world, components, std::move(discs));
  std::vector<DiscSums> sums(set.discs().size());
  add_batch(world, set, origins, {seed, 0, paths}, sums, rules);
  std::vector<Reading> readings;
  for (const DiscSums& s : sums) {
    const auto n = static_cast<double>(paths);
    readings.push_back({luminance(s.flux) / n, std::sqrt(variance_of(s, n)), s.crossings});
  }
  return readings;
}

/// A disc where a vertical ray from `above` meets the scene.
Disc disc_below(const World& world, const Vec3& above, float radius, const Vec3& way = {0, -1, 0}) {
  const auto hit = world.caster.closest({above, way}, 0);
  EXPECT_TRUE(hit);
  SurfacePoint point = world.surfaces.at(*hit);
  face(point, -way);
  return disc_at(point, Components(world.scene).of(hit->instance, hit->triangle), radius);
}

PunctualLight point_light(const Vec3& position, float candela) {
  PunctualLight light;
  light.kind = PunctualLight::Kind::kPoint;
  light.position = position;
  light.intensity = Spectrum(candela);
  return light;
}

void floor(SceneMaker& maker, float half, float height, std::uint32_t material) {
  maker.polygon(material, {{-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}});
}

void expect_near(const Reading& reading, double truth, double bias = 0) {
  EXPECT_NEAR(reading.irradiance, truth, kSigmas * reading.error + bias * truth) << reading.crossings << " crossings";
  EXPECT_GT(reading.crossings, 50U);
}

TEST(PathsStability, H50_FlatFloorLosesNothingToRounding) {
  // Far from the origin, so that coordinates are coarse: the disc lies in the very plane where segments end.
  for (const float away : {0.0F, 1000.0F}) {
    SceneMaker maker;
    const auto grey = maker.material(Spectrum(0.5F));
    maker.polygon(grey, {{away - 2, away, -2}, {away - 2, away, 2}, {away + 2, away, 2}, {away + 2, away, -2}});
    maker.light(point_light({away, away + 1, 0}, 100));
    const World world(maker.take());
    // E over a disc about the foot of the perpendicular: the flux of the cone, 2 pi I (1 - cos), over pi r^2.
    const double truth = 2 * kPiD * 100 * (1 - 1 / std::hypot(1, .2)) / (kPiD * .04);
    expect_near(read(world, {disc_below(world, {away, away + .5F, 0}, .2F)}, 100000)[0], truth, 1e-3);
  }
}

TEST(PathsStability, H50_TilesOfDifferentObjectsAreOneFloor) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.5F));
  for (float x = -2; x < 2; x += .25F)
    maker.polygon(grey, {{x, .1F, -2}, {x, .1F, 2}, {x + .25F, .1F, 2}, {x + .25F, .1F, -2}});
  maker.light(point_light({0, 1.1F, 0}, 100));
  const World world(maker.take());
  const double truth = 2 * kPiD * 100 * (1 - 1 / std::hypot(1, .3)) / (kPiD * .09);
  expect_near(read(world, {disc_below(world, {.01F, .5F, 0}, .3F)}, 100000)[0], truth, 2e-3);
}

TEST(PathsStability, H51_ParallelSegmentsNeverCount) {
  SceneMaker maker;
  maker.light(point_light({0, 0, 0}, 1));
  floor(maker, 1, -1, maker.material(Spectrum(0.5F)));
  const World world(maker.take());
  const Components components(world.scene);
  const DiscSet set(world, components, {disc_in_air({1, 0, 0}, {0, 1, 0}, .5F)});
  for (const float y : {0.0F, 1e-9F, -1e-9F, 1e-30F}) {
    Segment segment;
    segment.ray = {{0, 0, 0}, {1, y, 0}};
    segment.power = Spectrum(1.0F);
    EXPECT_EQ(Crossing(world, set, segment).at(0).whole, 0);
  }
}

TEST(PathsStability, H52_LightLeavingTheFloorIsNotCountedThere) {
  SceneMaker maker;
  const auto glowing = maker.material(Spectrum(0.9F), Spectrum(1.0F));
  floor(maker, 1, 0, glowing);
  const World world(maker.take());
  const Reading reading = read(world, {disc_below(world, {.1F, 1, .1F}, .5F)}, 10000)[0];
  EXPECT_EQ(reading.crossings, 0U);
  EXPECT_EQ(reading.irradiance, 0);
}

TEST(PathsStability, H54_CornerBesideAnEmittingWall) {
  // The wall x = 0 is 1 high and so long that its ends do not matter; B = 1. O6: F = (1 - x / sqrt(x^2 + 1)) / 2.
  SceneMaker maker;
  const auto dark = maker.material(Spectrum(0.0F));
  const auto wall = maker.material(Spectrum(0.0F), Spectrum(kInversePi));
  maker.polygon(dark, {{0, 0, -8}, {0, 0, 8}, {2, 0, 8}, {2, 0, -8}});
  maker.polygon(wall, {{0, 0, 8}, {0, 0, -8}, {0, 1, -8}, {0, 1, 8}});
  const World world(maker.take());
  const float r = .1F;
  const std::vector<float> distances{.01F, .25F, .5F, 1, 2};
  std::vector<Disc> discs;
  for (const float d : distances) discs.push_back(disc_below(world, {d * r, .5F, 0}, r));
  const auto corrected = read(world, discs, 1000000);
  const auto naive = read(world, discs, 1000000, {true, false, false});
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double x = static_cast<double>(distances[i] * r), truth = (1 - x / std::hypot(x, 1)) / 2;
    expect_near(corrected[i], truth, .06);
  }
  EXPECT_NEAR(naive[0].irradiance, .24, 5 * naive[0].error + .01);  // -52 %: half of the disc is behind the wall
}

TEST(PathsStability, H55_AcuteWedge) {
  // A furnace in a wedge of 10 degrees, closed by what glows: everything sends 1, so E = 1 (in pi L) everywhere.
  SceneMaker maker;
  const auto glow = maker.material(Spectrum(0.0F), Spectrum(kInversePi));
  const float rise = std::tan(10 * kPi / 180);
  maker.polygon(glow, {{0, 0, -1}, {0, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  maker.polygon(glow, {{0, 0, 1}, {0, 0, -1}, {1, rise, -1}, {1, rise, 1}});
  maker.polygon(glow, {{1, 0, 1}, {1, rise, 1}, {1, rise, -1}, {1, 0, -1}});
  maker.polygon(glow, {{0, 0, 1}, {1, rise, 1}, {1, 0, 1}});
  maker.polygon(glow, {{0, 0, -1}, {1, 0, -1}, {1, rise, -1}});
  const World world(maker.take());
  std::vector<Disc> discs;
  for (const float x : {.02F, .05F, .1F, .2F, .5F}) discs.push_back(disc_below(world, {x, x * rise / 2, 0}, .05F));
  for (const Reading& reading : read(world, discs, 1000000)) {
    EXPECT_GT(reading.irradiance, .5);
    EXPECT_LT(reading.irradiance, 2);
  }
}

TEST(PathsStability, H56_FlatToTheTablesEdge) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  maker.polygon(grey, {{-1, 1, -1}, {-1, 1, 1}, {0, 1, 1}, {0, 1, -1}});
  floor(maker, 3, 0, grey);
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::kDirectional;
  sun.direction = {0, -1, 0};
  sun.intensity = Spectrum(100.0F);
  maker.light(sun);
  const World world(maker.take());
  for (const float x : {-.001F, -.05F, -.1F})
    expect_near(read(world, {disc_below(world, {x, 2, 0}, .1F)}, 200000)[0], 100, 1e-3);
}

TEST(PathsStability, H57_ShadowOfABlockerCloserThanTheRadius) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  floor(maker, 2, 0, grey);
  floor(maker, .5F, .03F, grey);
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::kDirectional;
  sun.direction = {0, -1, 0};
  sun.intensity = Spectrum(100.0F);
  maker.light(sun);
  const World world(maker.take());
  const Reading shadow = read(world, {disc_below(world, {0, .02F, 0}, .2F)}, 200000)[0];
  EXPECT_LT(shadow.irradiance, 5);
}

TEST(PathsStability, H58_TinyRectangles) {
  // Leaves far smaller than the disc: what they miss crosses it all the same.
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  maker.polygon(grey, {{-.01F, 0, -.01F}, {-.01F, 0, .01F}, {.01F, 0, .01F}, {.01F, 0, -.01F}});
  floor(maker, 3, -2, grey);
  maker.light(point_light({0, 1, 0}, 100));
  const World world(maker.take());
  const double truth = 2 * kPiD * 100 * (1 - 1 / std::hypot(1, .2)) / (kPiD * .04);
  expect_near(read(world, {disc_below(world, {0, .5F, 0}, .2F)}, 200000)[0], truth, 1e-3);
}

Scene lit_sphere(float reflectance) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(reflectance));
  const test::Shape inside = test::sphere(1, 5).reversed();
  maker.mesh(grey, inside.positions, inside.triangles);
  maker.light(point_light({0, 0, 0}, static_cast<float>(1 / (4 * kPiD))));
  return maker.take();
}

TEST(PathsStability, H59_ConcaveSphere) {
  // O10: phi / (4 pi R^2 (1 - rho)) at every point.
  const World world(lit_sphere(.5F));
  const double truth = 1 / (4 * kPiD * .5);
  for (const float r : {.1F, .3F}) {
    const Disc disc = disc_below(world, {0, 0, 0}, r, normalize(Vec3(.3F, -1, .2F)));
    expect_near(read(world, {disc}, 200000)[0], truth, static_cast<double>(r * r));
    const Reading cut = read(world, {disc}, 200000, {false, true, true})[0];
    EXPECT_LT(cut.irradiance, .8 * truth);  // without going on to the second surface
  }
}

TEST(PathsStability, H60_ConvexSphereUnderAPointLight) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  const test::Shape ball = test::sphere(1, 5);
  maker.mesh(grey, ball.positions, ball.triangles);
  PunctualLight spot = point_light({0, 5, 0}, 2500);  // that sends all its paths to the ball
  spot.kind = PunctualLight::Kind::kSpot;
  spot.direction = {0, -1, 0};
  spot.cos_inner = std::cos(.25F);
  spot.cos_outer = std::cos(.3F);
  maker.light(spot);
  const World world(maker.take());
  const float r = .05F;
  const auto at = [&](double angle) {
    const Vec3 way = to_float(Vec3d(-std::sin(angle), -std::cos(angle), 0));
    return disc_below(world, way * -2, r, way);
  };
  const auto truth = [](double angle) {
    const double d2 = 26 - 10 * std::cos(angle);
    return 2500 * (5 * std::cos(angle) - 1) / (d2 * std::sqrt(d2));
  };
  const auto readings = read(world, {at(.01), at(.5), at(1), at(1.6), at(3)}, 200000);
  expect_near(readings[0], truth(.01), .02);
  expect_near(readings[1], truth(.5), .02);
  expect_near(readings[2], truth(1), .02);
  EXPECT_EQ(readings[3].crossings, 0U);  // beyond the terminator
  EXPECT_EQ(readings[4].crossings, 0U);
}

TEST(PathsStability, H61_ParallelSheetsDoNotLeak) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  floor(maker, 1, 0, grey);
  floor(maker, 1, 1e-4F, grey);
  maker.light(point_light({0, 1, 0}, 100));
  const World world(maker.take());
  const Disc lower = disc_below(world, {.1F, .5e-4F, .1F}, .05F);
  EXPECT_LT(read(world, {lower}, 200000)[0].irradiance, 100 * 1e-3);
  const Disc upper = disc_below(world, {.1F, .5F, .1F}, .05F);
  EXPECT_GT(read(world, {upper}, 200000)[0].irradiance, 90);
}

TEST(PathsStability, H61_ThinWallStandingOnTheFloor) {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(0.0F));
  floor(maker, 2, 0, grey);
  maker.polygon(grey, {{0, 0, 2}, {0, 0, -2}, {0, 2, -2}, {0, 2, 2}});
  maker.light(point_light({1, 1, 0}, 100));
  const World world(maker.take());
  const auto readings =
      read(world, {disc_below(world, {-.02F, 1, 0}, .2F), disc_below(world, {.02F, 1, 0}, .2F)}, 500000);
  EXPECT_LT(readings[0].irradiance, 1e-3 * readings[1].irradiance);  // the dark side of the wall
  const double d2 = 1 + .98 * .98;
  expect_near(readings[1], 100 / (d2 * std::sqrt(d2)), .06);  // the lit side loses nothing to the half behind the wall
}

TEST(PathsStability, H62_AnyNumberOfPaths) {
  const World world(lit_sphere(.5F));
  const Disc disc = disc_below(world, {0, 0, 0}, .3F);
  EXPECT_EQ(read(world, {disc}, 0)[0].crossings, 0U);
  EXPECT_GE(read(world, {disc}, 1)[0].irradiance, 0);
  // Paths beyond 2^32 have numbers of their own.
  const auto first_way = [&](std::uint64_t index) {
    Vec3 way;
    follow_path(world, 1, index, [&](const Segment& s) { way = s.bounce == 0 ? s.ray.direction : way; });
    return way;
  };
  EXPECT_NE(first_way(1), first_way((std::uint64_t{1} << 32) + 1));
  EXPECT_NE(first_way(1), first_way((std::uint64_t{1} << 31) + 1));
  EXPECT_EQ(first_way((std::uint64_t{1} << 31) + 1), first_way((std::uint64_t{1} << 31) + 1));
}

TEST(PathsStability, H64_ManyDiscsOnOneSegment) {
  SceneMaker maker;
  floor(maker, 2, 0, maker.material(Spectrum(0.0F)));
  maker.light(point_light({0, 1, 0}, 100));
  const World world(maker.take());
  const Disc disc = disc_below(world, {0, .5F, 0}, .2F);
  const auto readings = read(world, std::vector<Disc>(100000, disc), 100);
  for (const Reading& reading : readings) EXPECT_EQ(reading.crossings, readings[0].crossings);
  EXPECT_GT(readings[0].crossings, 0U);
}

TEST(PathsStability, DiscsLargerThanTheScene) {  // H53: the mean flux
  const World world(lit_sphere(0));
  const Reading reading = read(world, {disc_in_air({0, -.01F, 0}, {0, 1, 0}, 100)}, 10000, {true, true, false})[0];
  // Of the light of 1 lm from the centre, half goes down: over the area of the disc.
  EXPECT_NEAR(reading.irradiance, .5 / (kPiD * 1e4), kSigmas * reading.error);
}

}  // namespace
}  // namespace radfarm
