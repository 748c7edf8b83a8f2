#include "radiosity/solve.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "math/statistics.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

RadiositySettings quick() {
  RadiositySettings settings;
  settings.max_link_error = 1e-3F;
  settings.min_patch_area = 1e-3F;
  return settings;
}

// The budget of a solve: links and residual may misplace light of this share (DESIGN, radiosity).
constexpr double kBudget = 0.01;

void expect_closed_ledger(const EnergyLedger& energy) {
  EXPECT_NEAR(energy.absorbed + energy.escaped + energy.truncated, energy.emitted, 1e-9 * energy.emitted);
  EXPECT_GE(energy.absorbed, 0);
  EXPECT_GE(energy.truncated, 0);
}

TEST(SolveRadiosity, AFurnaceAbsorbsWhatItEmits) {
  const World world(test::own_scene("furnace"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  const double emitted = std::numbers::pi * 24;
  EXPECT_NEAR(solution.energy.emitted, emitted, 1e-5 * emitted);
  EXPECT_NEAR(solution.energy.absorbed, emitted, kBudget * emitted);
  EXPECT_NEAR(solution.energy.escaped, 0, kBudget * emitted);
  // B = 2 pi, half of it reflected.
  EXPECT_NEAR(luminance(SpectrumD(solution.reflected_power[0])), emitted, kBudget * emitted);
  expect_closed_ledger(solution.energy);
}

TEST(SolveRadiosity, EveryPatchOfAFurnaceReflectsTheSame) {
  // Over seeds: one solve's links are noisy, their mean may be off by the budget alone. Level 1e-6 over the patches.
  const World world(test::own_scene("furnace"));
  std::vector<RunningStatistics> density;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const RadiositySolution solution = solve_radiosity(world, quick(), seed);
    density.resize(solution.hierarchy.leaves.size());
    for (const std::uint32_t leaf : solution.hierarchy.leaves) {
      const Node& node = solution.hierarchy.nodes[leaf];
      density[node.first_leaf].add(luminance(SpectrumD(solution.reflected_power[leaf])) /
                                   static_cast<double>(node.area));
    }
  }
  ASSERT_EQ(density.size(), 12U);
  const double deviations = student_t_quantile(1 - test::sidak_level(1e-6, density.size()) / 2, 23);
  for (const RunningStatistics& d : density) {
    EXPECT_NEAR(d.mean(), std::numbers::pi, kBudget * std::numbers::pi + deviations * d.standard_error());
  }
}

TEST(SolveRadiosity, EmittedIsAbsorbedEscapedAndTruncated) {
  for (const char* name : {"plates", "cornell", "emitters_reflect", "point_light"}) {
    SCOPED_TRACE(name);
    const World world(test::own_scene(name));
    const RadiositySolution solution = solve_radiosity(world, quick(), 2);
    expect_closed_ledger(solution.energy);
    EXPECT_LE(solution.energy.truncated, 1.001e-3 * solution.energy.emitted);
  }
}

TEST(SolveRadiosity, LinksAndPathsAgree) {
  // Totals, over seeds: links may misplace a share of kBudget in each of the few reflections that matter, 3 %. Level 1e-6.
  const World world(test::own_scene("cornell"));
  RadiositySettings settings = quick();
  RunningStatistics ratio, escaped;
  constexpr int kSeeds = 16;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    settings.hits_per_patch = 0;
    const RadiositySolution links = solve_radiosity(world, settings, seed);
    settings.hits_per_patch = 16;
    const RadiositySolution paths = solve_radiosity(world, settings, seed);
    ASSERT_EQ(links.reflected_power.size(), paths.reflected_power.size());
    const double by_links = luminance(SpectrumD(links.reflected_power[0]));
    const double by_paths = luminance(SpectrumD(paths.reflected_power[0]));
    EXPECT_NE(by_paths, by_links);
    ratio.add(by_paths / by_links);
    escaped.add((paths.energy.escaped - links.energy.escaped) / links.energy.emitted);
    expect_closed_ledger(links.energy);
    expect_closed_ledger(paths.energy);
  }
  RecordProperty("ratio", std::to_string(ratio.mean()));
  const double deviations = student_t_quantile(1 - test::sidak_level(1e-6, 2) / 2, kSeeds - 1);
  EXPECT_NEAR(ratio.mean(), 1, 3 * kBudget + deviations * ratio.standard_error());
  EXPECT_NEAR(escaped.mean(), 0, 3 * kBudget + deviations * escaped.standard_error());
  EXPECT_LT(deviations * ratio.standard_error(), 0.03);  // else the test says little
}

TEST(SolveRadiosity, PlatesGetTheirFormFactor) {
  const World world(test::own_scene("plates"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 3);
  // The emitter is black: the receiver reflects rho F pi L_e once.
  const double truth = 0.5 * 0.1998248957 * std::numbers::pi;
  EXPECT_NEAR(luminance(SpectrumD(solution.reflected_power[0])), truth, kBudget * truth);
}

TEST(SolveRadiosity, NothingLeaksThroughASheet) {
  const World world(test::own_scene("sheet"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  const Hierarchy& h = solution.hierarchy;
  const float middle = static_cast<float>(1 - world.scene.origin.x);
  double lit = 0;
  for (std::uint32_t i = 0; i < h.nodes.size(); ++i) {
    if (h.nodes[i].is_cluster()) continue;
    const bool is_dark = h.nodes[i].bounds.max.x > middle + 1e-4F ||
                         (h.nodes[i].bounds.min.x > middle - 1e-4F && h.patches[h.nodes[i].patch].normal.x > 0);
    const double reflected = luminance(SpectrumD(solution.reflected_power[i]));
    EXPECT_TRUE(!is_dark || reflected == 0) << reflected;
    lit += reflected;
  }
  EXPECT_GT(lit, 0);
}

TEST(SolveRadiosity, PowersAddUpFromPartsToWholes) {
  const World world(test::own_scene("cornell"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  ASSERT_EQ(solution.reflected_power.size(), solution.hierarchy.nodes.size());
  for (std::size_t i = 0; i < solution.hierarchy.nodes.size(); ++i) {
    const Node& node = solution.hierarchy.nodes[i];
    if (node.child_count == 0) continue;
    double sum = 0;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      sum += luminance(SpectrumD(solution.reflected_power[node.first_child + c]));
    }
    EXPECT_NEAR(luminance(SpectrumD(solution.reflected_power[i])), sum, 1e-5 * sum);
  }
}

TEST(SolveRadiosity, HasTheSameBitsForAnyNumberOfThreads) {
  const World world(test::own_scene("cornell"));
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return solve_radiosity(world, quick(), 7);
  };
  const RadiositySolution one = with(1), two = with(2);
  EXPECT_EQ(one.reflected_power, two.reflected_power);
  EXPECT_EQ(one.links, two.links);
  EXPECT_EQ(one.iterations, two.iterations);
  EXPECT_EQ(one.hierarchy.nodes.size(), two.hierarchy.nodes.size());
  EXPECT_EQ(one.energy.absorbed, two.energy.absorbed);
  EXPECT_EQ(one.energy.closure_error, two.energy.closure_error);
}

TEST(SolveRadiosity, ASceneWithoutLightHasNoSolution) {
  test::SceneMaker maker;
  const std::uint32_t grey = maker.material(Spectrum(0.5F));
  const World world(maker.room({grey, grey, grey, grey, grey, grey}, {0, 0, 0}, {1, 1, 1}).take());
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  EXPECT_EQ(solution.links, 0U);
  EXPECT_EQ(solution.energy.emitted, 0);
}

}  // namespace
}  // namespace radfarm
