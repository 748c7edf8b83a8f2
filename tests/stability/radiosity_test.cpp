#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "math/polygon_irradiance.h"
#include "math/statistics.h"
#include "radiosity/solve.h"
#include "scene/clean.h"
#include "scene/recentre.h"
#include "support/closed_forms.h"
#include "support/closed_scenes.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

using test::SceneMaker;
using test::Sent;

constexpr std::size_t kLaws = 12;  // expect_truth() in this file
const double kLevel = test::sidak_level(1e-6, kLaws);
const float kUnit = static_cast<float>(1 / std::numbers::pi);  // radiance of exitance 1

RadiositySettings quick(std::uint32_t hits = 4) {
  RadiositySettings settings;
  settings.max_link_error = 1e-2F;
  settings.hits_per_patch = hits;
  return settings;
}

/// The mean answer over seeds is the truth within its own noise and `share` of it, the tolerance of the case.
void expect_truth(test::ClosedForm form, double share, int seeds = 16) {
  SCOPED_TRACE(form.name);
  const World world(std::move(form.scene));
  RunningStatistics answers;
  for (int seed = 1; seed <= seeds; ++seed) {
    answers.add(form.answer(world, solve_radiosity(world, quick(), static_cast<std::uint64_t>(seed))));
  }
  const double noise = student_t_quantile(1 - kLevel / 2, seeds - 1) * answers.standard_error();
  EXPECT_NEAR(answers.mean(), form.truth, noise + (form.truth_error + share) * form.truth);
  EXPECT_LT(noise, 0.1 * form.truth) << "says too little";
}

/// Finite, nowhere negative, and no more absorbed than emitted but for the noise of `share`.
void expect_sound(const RadiositySolution& solution, double share) {
  for (const Spectrum& power : solution.reflected_power) {
    ASSERT_TRUE(is_finite(power));
    ASSERT_GE(min_component(power), 0);
  }
  EXPECT_LE(solution.energy.absorbed, (1 + share) * solution.energy.emitted);
  EXPECT_TRUE(std::isfinite(solution.energy.closure_error));
}

/// A room in which each side differs, with a lamp below the ceiling.
Scene small_room(const Spectrum& lamp = Spectrum(5.0F)) {
  SceneMaker maker;
  const std::uint32_t a = maker.material({0.5F, 0.25F, 0.75F}), b = maker.material(Spectrum(0.75F));
  const std::uint32_t light = maker.material(Spectrum(0.25F), lamp);
  maker.room({a, b, a, b, a, b}, {-1, 0, -1}, {1, 1.5F, 1});
  maker.polygon(light, {{-0.25F, 1.25F, -0.25F}, {0.25F, 1.25F, -0.25F}, {0.25F, 1.25F, 0.25F}, {-0.25F, 1.25F, 0.25F}});
  return maker.take();
}

RadiositySolution solve(const Scene& scene, std::uint32_t hits = 4) { return solve_radiosity(World(scene), quick(hits), 1); }

void expect_same_bits(const RadiositySolution& a, const RadiositySolution& b) {
  EXPECT_EQ(a.links, b.links);
  EXPECT_EQ(a.reflected_power, b.reflected_power);
  EXPECT_EQ(a.energy.absorbed, b.energy.absorbed);
}

// H1, H5: what adds nothing changes nothing.
TEST(RadiosityHardCases, H1H5DegenerateAndRepeatedTrianglesChangeNothing) {
  Scene plain = small_room(), worse = small_room();
  for (Mesh& mesh : worse.meshes) {
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({2, 1, 2});
    mesh.triangles.push_back(mesh.triangles[0]);
  }
  clean_scene(plain);
  clean_scene(worse);
  expect_same_bits(solve(plain), solve(worse));
}

// H2: a strip of width 1e-6 across the floor, of two slivers, and the same strip as a lamp.
TEST(RadiosityHardCases, H2SliversReceiveAndSendWhatTheirStripDoes) {
  for (const bool is_lamp : {false, true}) {
    SceneMaker maker;
    const std::vector<Vec3> strip = {{0, 0, -0.5F}, {0, 0, 0.5F}, {1e-6F, 0, 0.5F}, {1e-6F, 0, -0.5F}};
    const std::vector<Vec3> square = {{-0.5F, 1, -0.5F}, {0.5F, 1, -0.5F}, {0.5F, 1, 0.5F}, {-0.5F, 1, 0.5F}};
    maker.material(Spectrum(0.0F), Spectrum(is_lamp ? 1e6F * kUnit : kUnit));
    maker.material(Spectrum(0.5F));
    maker.polygon(is_lamp ? 0 : 1, strip).polygon(is_lamp ? 1 : 0, square);
    test::ClosedForm form{"H2", is_lamp ? "lamp" : "receiver", maker.take()};
    // From the strip to the square, by reciprocity from each to each of 1 m^2 or 1e-6: the strip's line integral, by Simpson's rule.
    const std::vector<Vec3d> above = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    double factor = 0;
    constexpr int kIntervals = 200;
    for (int k = 0; k <= kIntervals; ++k) {
      const double weight = k == 0 || k == kIntervals ? 1 : k % 2 == 1 ? 4 : 2;
      const Vec3d at(0, 0, static_cast<double>(k) / kIntervals - 0.5);
      factor += weight / (3 * kIntervals) * polygon_form_factor(above, at, Vec3d(0, 1, 0));
    }
    form.truth = 0.5 * factor;
    form.answer = [](const World& w, const RadiositySolution& s) { return test::reflected_exitance(w, s, 1); };
    expect_truth(std::move(form), 1e-5, 48);
  }
}

// H4: the lamp lies in the very plane of the ceiling, which goes on behind it.
TEST(RadiosityHardCases, H4ALampInThePlaneOfTheCeilingShinesOnce) {
  SceneMaker maker;
  maker.material(Spectrum(0.0F), Spectrum(kUnit));
  maker.material(Spectrum(0.5F));
  maker.material(Spectrum(0.0F));
  maker.polygon(0, {{0.25F, 1, 0.25F}, {0.75F, 1, 0.25F}, {0.75F, 1, 0.75F}, {0.25F, 1, 0.75F}});
  maker.polygon(1, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  maker.polygon(2, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}});
  test::ClosedForm form{"H4", "lamp in the ceiling", maker.take()};
  // From the lamp to the floor, by parts: parallel rectangles on one axis, 1/2 and 1 wide. [factors of differences, O1]
  const auto k = [](double side) { return side * side * test::parallel_rectangles(side, side, 1); };
  const auto mixed = [](double a, double b) { return a * b * test::parallel_rectangles(a, b, 1); };
  const double exchange = (k(0.75) + k(0.25) - 2 * mixed(0.75, 0.25));
  form.truth = 0.5 * exchange;
  form.answer = [](const World& w, const RadiositySolution& s) { return test::reflected_exitance(w, s, 1); };
  expect_truth(std::move(form), 1e-3);
}

// H6, H21: a receiver in the emitter's plane, and one that faces away, get exactly nothing.
TEST(RadiosityHardCases, H6H21OnThePlaneOrFacingAwayIsExactlyDark) {
  SceneMaker maker;
  const std::uint32_t lamp = maker.material(Spectrum(0.5F), Spectrum(1.0F));
  const std::uint32_t beside = maker.material(Spectrum(0.5F)), behind = maker.material(Spectrum(0.5F));
  maker.polygon(lamp, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  maker.polygon(beside, {{1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}});
  maker.polygon(behind, {{0, -1, 0}, {0, -1, 1}, {1, -1, 1}, {1, -1, 0}});
  const World world(maker.take());
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(world, quick(hits), 1);
    for (std::size_t i = 0; i < solution.reflected_power.size(); ++i) EXPECT_TRUE(is_black(solution.reflected_power[i]));
    EXPECT_EQ(solution.energy.absorbed, 0);
  }
}

// H7, H9: open and self-intersecting.
TEST(RadiosityHardCases, H7H9OpenAndIntersectingMeshesKeepTheLedger) {
  SceneMaker maker;
  const std::uint32_t m = maker.material(Spectrum(0.75F), Spectrum(1.0F)), grey = maker.material(Spectrum(0.5F));
  maker.polygon(m, {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  maker.polygon(grey, {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}});            // through the middle
  maker.polygon(grey, {{-1, -1, 0}, {1, 1, 0.25F}, {1, 1, -0.25F}});                // through both
  maker.polygon(grey, {{-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}});          // three faces on an edge
  maker.polygon(grey, {{-1, 0, -1}, {1, 0, -1}, {1, -1, -1}, {-1, -1, -1}});
  const World world(maker.take());
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(world, quick(hits), 1);
    expect_sound(solution, 0);
    EXPECT_GT(solution.energy.escaped, 0.1 * solution.energy.emitted);
  }
}

// H11: strips 10000 times longer than wide.
TEST(RadiosityHardCases, H11LongStripsHaveTheirFormFactor) {
  expect_truth(test::parallel_plates(1, 1e4, 1, Sent::kEmitted), 1e-3);
}

Scene scaled(Scene scene, float factor) {
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& p : mesh.positions) p *= factor;
  }
  return scene;
}

// H12: by a power of two, nothing is rounded differently: the same irradiance to the last bit.
TEST(RadiosityHardCases, H12TheUnitOfLengthDoesNotMatter) {
  const RadiositySolution metres = solve(small_room());
  for (const int exponent : {-20, 20}) {
    RadiositySolution other = solve(scaled(small_room(), std::ldexp(1.0F, exponent)));
    EXPECT_EQ(other.links, metres.links);
    for (Spectrum& power : other.reflected_power) power *= std::ldexp(1.0F, -2 * exponent);
    EXPECT_EQ(other.reflected_power, metres.reflected_power);
  }
}

TEST(RadiosityHardCases, H12MillionsAndMillionthsOfAMetreLoseFiveDigitsAtMost) {
  // Direct light alone: what is cut where may change with the rounding, what a patch gets may not.
  const auto floor_of = [](float factor) {
    Scene scene = scaled(small_room(), factor);
    const World world(std::move(scene));
    return test::reflected_exitance(world, solve_radiosity(world, quick(0), 1), 0);
  };
  const double metres = floor_of(1);
  EXPECT_NEAR(floor_of(1e6F), metres, 1e-5 * metres);
  EXPECT_NEAR(floor_of(1e-6F), metres, 1e-5 * metres);
}

// H13: as a loader gives it, a million metres away.
TEST(RadiosityHardCases, H13APlaceFarAwayChangesNothing) {
  const auto placed = [](double offset) {
    DraftScene draft;
    draft.scene = small_room();
    for (Mesh& mesh : draft.scene.meshes) {
      draft.positions.emplace_back();
      for (const Vec3& p : mesh.positions) draft.positions.back().push_back(to_double(p) + Vec3d(offset));
    }
    draft.instance_to_world.resize(draft.scene.instances.size());
    return recentre(std::move(draft));
  };
  expect_same_bits(solve(placed(0)), solve(placed(1048576)));
}

// H22: a square that rises a little over a length of 1, beside the lamp that it nearly lies in the plane of.
TEST(RadiosityHardCases, H22GrazingLightFallsToZeroAndNotBelow) {
  const auto received = [](float rise) {
    SceneMaker maker;
    maker.material(Spectrum(0.0F), Spectrum(kUnit));
    maker.material(Spectrum(0.5F));
    maker.polygon(0, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
    maker.polygon(1, {{1, 0, 0}, {1, 0, 1}, {2, rise, 1}, {2, rise, 0}});
    const World world(maker.take());
    RunningStatistics exitance;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      const RadiositySolution solution = solve_radiosity(world, quick(), seed);
      expect_sound(solution, 0);
      exitance.add(test::reflected_exitance(world, solution, 1));
    }
    return exitance.mean();
  };
  // Both cosines are at most the rise over a distance of at least the strip's own: E <= 1/2 rise^2, far less than 1e-6.
  EXPECT_GT(received(1e-2F), 0);
  EXPECT_LE(received(1e-2F), 0.5 * 0.5 * 1e-4);
  EXPECT_NEAR(received(1e-5F), 0, 1e-6);
  EXPECT_EQ(received(0), 0);
}

// H23: a lamp of 1e-12 m^2.
TEST(RadiosityHardCases, H23ATinyLampShinesAsAPoint) {
  SceneMaker maker;
  constexpr float kSide = 1e-6F;
  maker.material(Spectrum(0.0F), Spectrum(kUnit / (kSide * kSide)));
  maker.material(Spectrum(0.5F));
  maker.polygon(0, {{0, 1, 0}, {kSide, 1, 0}, {kSide, 1, kSide}, {0, 1, kSide}});
  maker.polygon(1, {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  test::ClosedForm form{"H23", "lamp of a square micrometre", maker.take()};
  form.truth = 0.5 * 0.5541264240 / 4;  // O5: of 1 lm, over 4 m^2
  form.answer = [](const World& w, const RadiositySolution& s) { return test::reflected_exitance(w, s, 1); };
  expect_truth(std::move(form), 1e-4);
}

// H24: a lamp as large as a sky.
TEST(RadiosityHardCases, H24AHugeLampFillsTheHemisphere) {
  SceneMaker maker;
  constexpr float kSide = 1e4F;
  maker.material(Spectrum(0.0F), Spectrum(kUnit));
  maker.material(Spectrum(0.5F));
  maker.polygon(0, {{-kSide, 1, -kSide}, {kSide, 1, -kSide}, {kSide, 1, kSide}, {-kSide, 1, kSide}});
  maker.polygon(1, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  test::ClosedForm form{"H24", "lamp of 400 square kilometres", maker.take()};
  form.truth = 0.5;
  form.answer = [](const World& w, const RadiositySolution& s) { return test::reflected_exitance(w, s, 1); };
  expect_truth(std::move(form), 1e-3, 64);  // four samples a triangle: it is a small share of the scene
}

// H25: one line a link.
TEST(RadiosityHardCases, H25OneSampleALinkStillConservesEnergy) {
  test::ClosedForm form = test::furnace(test::Furnace::kCluttered, 0.5F);
  const World world(std::move(form.scene));
  RadiositySettings settings = quick(0);
  settings.samples_per_link = 1;
  const RadiositySolution solution = solve_radiosity(world, settings, 1);
  expect_sound(solution, 1e-3);
  EXPECT_NEAR(form.answer(world, solution), form.truth, 0.01 * form.truth);
}

// H27: light that reaches nothing.
TEST(RadiosityHardCases, H27LightThatMeetsNothingLeavesZeros) {
  SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F), Spectrum(1.0F)), {{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}});
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  const RadiositySolution solution = solve(maker.take());
  expect_sound(solution, 0);
  for (const Spectrum& power : solution.reflected_power) EXPECT_TRUE(is_black(power));
}

// H31: who asks for it gets an end, and is told what is missing.
TEST(RadiosityHardCases, H31ALosslessRoomEndsTruncated) {
  const World world(test::furnace(test::Furnace::kBox, 1.0F).scene);
  RadiositySettings uncut = quick(0);
  uncut.min_patch_area = 1;
  const RadiositySolution solution = solve_radiosity(world, uncut, 1);
  expect_sound(solution, 0);
  EXPECT_GT(solution.energy.truncated, 0.9 * solution.energy.emitted);
}

// H33: black everywhere.
TEST(RadiosityHardCases, H33BlackSurfacesReflectNothing) {
  const World world(test::furnace(test::Furnace::kBox, 0.0F).scene);
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  EXPECT_TRUE(is_black(solution.reflected_power[0]));
  EXPECT_NEAR(solution.energy.absorbed, solution.energy.emitted, 1e-5 * solution.energy.emitted);
}

// H35, H39: channels know nothing of each other.
TEST(RadiosityHardCases, H35H39EachChannelHasItsOwnFurnace) {
  SceneMaker maker;
  const std::uint32_t m = maker.material({0.9F, 0.5F, 0.0F}, {kUnit, 0, kUnit});
  const World world(maker.room({m, m, m, m, m, m}, Vec3(0.0F), Vec3(1.0F)).take());
  for (const std::uint32_t hits : {0U, 4U}) {
    const RadiositySolution solution = solve_radiosity(world, quick(hits), 1);
    const Spectrum power = solution.reflected_power[0] / 6.0F;
    EXPECT_NEAR(power.r, 9, 0.01 * 9);
    EXPECT_EQ(power.g, 0);
    EXPECT_EQ(power.b, 0);
  }
}

// H37: two rooms, one with a lamp that is 1e10 times brighter.
TEST(RadiosityHardCases, H37AWeakLampLightsItsOwnRoom) {
  SceneMaker maker;
  const std::uint32_t bright = maker.material(Spectrum(0.5F), Spectrum(1e10F * kUnit));
  const std::uint32_t dim = maker.material(Spectrum(0.5F), Spectrum(kUnit));
  maker.room({bright, bright, bright, bright, bright, bright}, Vec3(0.0F), Vec3(1.0F));
  maker.room({dim, dim, dim, dim, dim, dim}, Vec3(2.0F), Vec3(3.0F));
  const World world(maker.take());
  EXPECT_NEAR(test::reflected_exitance(world, solve_radiosity(world, quick(), 1), dim), 1, 0.05);
}

// H38: a thousand times the light is a thousand times the radiosity; by a power of two, to the last bit.
TEST(RadiosityHardCases, H38TwiceTheLightIsTwiceTheRadiosity) {
  const RadiositySolution one = solve(small_room()), more = solve(small_room(Spectrum(5120.0F)));
  EXPECT_EQ(one.links, more.links);
  std::vector<Spectrum> expected = one.reflected_power;
  for (Spectrum& power : expected) power *= 1024.0F;
  EXPECT_EQ(more.reflected_power, expected);
}

}  // namespace
}  // namespace radfarm
