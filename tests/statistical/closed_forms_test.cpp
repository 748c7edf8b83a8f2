// The radiosity solver against closed forms, at one setting each. docs/radiosity-closed-forms.md has the whole table.

#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "math/statistics.h"
#include "support/closed_forms.h"
#include "support/closed_scenes.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

using test::ClosedForm;
using test::Sent;

constexpr std::size_t kTests = 19;  // of laws, in this file
const double kLevel = test::sidak_level(1e-6, kTests);

RadiositySettings with(float max_link_error, std::uint32_t hits) {
  RadiositySettings settings;
  settings.max_link_error = max_link_error;
  settings.min_patch_area = 1e-3F;  // quick
  settings.hits_per_patch = hits;
  return settings;
}

/// The mean answer over seeds is the truth, within its own noise (Student's law at kLevel), what the truth leaves out, and
/// `bound`: what the solve may misplace, relative.
void expect_truth(ClosedForm form, const RadiositySettings& settings, int seeds, double bound) {
  SCOPED_TRACE(form.form + " " + form.name + (settings.hits_per_patch == 0 ? ", links" : ", paths"));
  const World world(std::move(form.scene));
  RunningStatistics answers;
  for (int seed = 1; seed <= seeds; ++seed) {
    answers.add(form.answer(world, solve_radiosity(world, settings, static_cast<std::uint64_t>(seed))));
  }
  const double deviations = student_t_quantile(1 - kLevel / 2, seeds - 1);
  const double noise = deviations * answers.standard_error();
  EXPECT_NEAR(answers.mean(), form.truth, noise + (form.truth_error + bound) * form.truth);
  EXPECT_LT(noise, 0.15 * form.truth) << "says too little";
  ::testing::Test::RecordProperty("relative_error", std::to_string(answers.mean() / form.truth - 1));
}

// Direct light and, with a sender that is lit evenly, what links and paths carry: both unbiased. Links alone get their total from
// 4096 rays (radiosity.6), which have no bias either.
constexpr double kUnbiased = 0;
constexpr int kSeeds = 24;

TEST(ClosedForms, O1ParallelRectangles) {
  expect_truth(test::parallel_plates(1, 1, 1, Sent::kEmitted), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::parallel_plates(1, 1, 0.1, Sent::kEmitted), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::parallel_plates(1, 1, 0.01, Sent::kEmitted), with(1e-3F, 0), kSeeds, kUnbiased);
  // Rays of directions have 2 F of the weights there, 6.4e-5, and none of 10000 is likely to meet the lamp.
  expect_truth(test::parallel_plates(1, 1, 100, Sent::kEmitted), with(1e-3F, 0), kSeeds, 2 * 3.2e-5);
  expect_truth(test::parallel_plates(1, 1.5, 0.5, Sent::kReflected), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::parallel_plates(1, 1.5, 0.5, Sent::kReflected), with(1e-3F, 16), kSeeds, kUnbiased);
}

TEST(ClosedForms, O2RectanglesThatShareAnEdge) {
  expect_truth(test::corner(1, 1, 1, Sent::kEmitted), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::corner(0.1, 1, 1, Sent::kEmitted), with(1e-4F, 0), kSeeds, kUnbiased);
  expect_truth(test::corner(1, 1, 1, Sent::kReflected), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::corner(1, 1, 1, Sent::kReflected), with(1e-3F, 16), kSeeds, kUnbiased);
  expect_truth(test::corner(1, 1, 10, Sent::kReflected), with(1e-3F, 0), kSeeds, kUnbiased);
}

TEST(ClosedForms, O3CoaxialDiscs) {
  expect_truth(test::discs(1, 1, 1, Sent::kEmitted), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::discs(1, 2, 1, Sent::kReflected), with(1e-3F, 0), kSeeds, kUnbiased);
  expect_truth(test::discs(1, 2, 1, Sent::kReflected), with(1e-3F, 16), kSeeds, kUnbiased);
}

// As it is by default: links guess, paths put it right. Links alone are biased here where clusters send and receive (the table says
// by how much), so nothing is asserted of them. Iterations that stop early only change the guess.
void expect_truth_by_paths(const ClosedForm& form) { expect_truth(form, with(1e-2F, 4), 10, kUnbiased); }

TEST(ClosedForms, O10IntegratingSphere) { expect_truth_by_paths(test::integrating_sphere(0.9F)); }
TEST(ClosedForms, O11DomeOverADisc) { expect_truth_by_paths(test::dome_over_disc(0.8F)); }
TEST(ClosedForms, O12ConcentricSpheres) { expect_truth_by_paths(test::concentric_spheres(0.5F)); }
TEST(ClosedForms, O13WideParallelPlates) { expect_truth_by_paths(test::wide_plates(0.5F)); }
TEST(ClosedForms, O19BoxAgainstADenseSystem) { expect_truth_by_paths(test::coloured_box()); }

/// H32: within 1 %, whatever the seed.
void expect_furnace(test::Furnace shape, float reflectance, std::uint32_t hits) {
  ClosedForm form = test::furnace(shape, reflectance);
  SCOPED_TRACE(form.name + (hits == 0 ? ", links" : ", paths"));
  const World world(std::move(form.scene));
  const RadiositySolution solution = solve_radiosity(world, with(1e-2F, hits), 1);
  EXPECT_NEAR(form.answer(world, solution), form.truth, 0.01 * form.truth);
  const EnergyLedger& energy = solution.energy;
  EXPECT_NEAR(energy.absorbed, energy.emitted, 0.01 * energy.emitted);
  EXPECT_LE(energy.truncated, 1.001e-3 * energy.emitted);
}

TEST(ClosedForms, O9FurnacesOfLinks) {
  using test::Furnace;
  for (const float reflectance : {0.5F, 0.9F, 0.99F}) expect_furnace(Furnace::kBox, reflectance, 0);
  for (const Furnace shape : {Furnace::kBox, Furnace::kSphere, Furnace::kCluttered}) expect_furnace(shape, 0.999F, 0);
}

TEST(ClosedForms, O9FurnacesOfPaths) {
  using test::Furnace;
  for (const Furnace shape : {Furnace::kBox, Furnace::kSphere, Furnace::kCluttered}) expect_furnace(shape, 0.9F, 4);
  expect_furnace(Furnace::kBox, 0.999F, 4);
}

/// A furnace with a perfect mirror for a wall: E = pi / (1 - rho) on the other five, 20 m^2.
void expect_mirrored_furnace(float reflectance, std::uint32_t hits) {
  SCOPED_TRACE(std::to_string(reflectance) + (hits == 0 ? ", links" : ", paths"));
  Scene scene = test::own_scene("effects/glowing_box");
  for (Material& material : scene.materials) {
    if (!is_black(material.emission)) material.base_color = Spectrum(reflectance);
  }
  const World world(std::move(scene));
  const RadiositySolution solution = solve_radiosity(world, with(1e-2F, hits), 1);
  const double rho = static_cast<double>(reflectance), truth = 20 * std::numbers::pi / (1 - rho);  // lm that arrive
  EXPECT_NEAR(luminance(SpectrumD(solution.reflected_power[0])), rho * truth, 0.01 * truth);
}

TEST(ClosedForms, O9FurnacesWithAMirror) {
  expect_mirrored_furnace(0.5F, 0);  // links alone know what the mirror sends from a few paths: 1.7 % off at .9
  for (const float reflectance : {0.5F, 0.9F}) expect_mirrored_furnace(reflectance, 16);
}

TEST(ClosedForms, TheFormulasHaveTheirGoldenValues) {
  // ALGORITHMS.md 3.1, to the digits printed there.
  EXPECT_NEAR(test::parallel_rectangles(1, 1, 1), 0.1998248957, 1e-10);
  EXPECT_NEAR(test::parallel_rectangles(1, 1, 100), 3.18288662e-5, 1e-7 * 3.2e-5);
  EXPECT_NEAR(test::perpendicular_rectangles(1, 1, 1), 0.2000437761, 1e-10);
  EXPECT_NEAR(test::perpendicular_rectangles(0.1, 1, 1), 0.4325136940, 1e-10);
  EXPECT_NEAR(test::coaxial_discs(1, 1, 1), 0.3819660113, 1e-10);
  EXPECT_NEAR(test::surrounded(1, 0, 0.5, 0.5, 1, 2).b2, 0.4, 1e-12);
  EXPECT_NEAR(test::surrounded(1, 0, 0.5, 0.5, 1, 4).b2, 2.0 / 9, 1e-12);
  EXPECT_NEAR(test::two_surfaces(1, 0, 0.5, 0.5, {{0, 1}, {1, 0}}).b1, 4.0 / 3, 1e-12);
}

}  // namespace
}  // namespace radfarm
