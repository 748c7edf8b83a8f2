#include "radiosity/irradiance.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "math/statistics.h"
#include "radiosity/deliveries.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

RadiositySettings quick() {
  RadiositySettings settings;
  settings.max_link_error = 1e-3F;
  settings.min_patch_area = 1e-3F;
  return settings;
}

// Over seeds the mean may be off by the solve's budget (solve_test); on top of that Student's t at level 1e-6.
constexpr double kBudget = 0.01;
constexpr int kSeeds = 12;

double light_of(const RadiositySolution& solution, const std::vector<Irradiance>& irradiance) {
  double sum = 0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    sum += static_cast<double>(luminance(irradiance[i].total()) * solution.hierarchy.nodes[i].area);
  }
  return sum;
}

void expect_near(const RunningStatistics& of, double truth) {
  const double deviations = student_t_quantile(1 - 1e-6 / 2, kSeeds - 1);
  EXPECT_NEAR(of.mean(), truth, kBudget * truth + deviations * of.standard_error());
}

TEST(Irradiance, OfAFurnaceIsItsClosedForm) {
  const World world(test::own_scene("furnace"));
  RunningStatistics light;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const RadiositySolution solution = solve_radiosity(world, quick(), seed);
    light.add(light_of(solution, gather_irradiance(world, solution, 16, seed)));
  }
  expect_near(light, 2 * std::numbers::pi * 24);  // E = pi L, L = 2, on 24 m^2
}

// A patch that reflects nothing has irradiance too: of a black room, all the light that is emitted.
TEST(Irradiance, IsKnownWhereNothingIsReflected) {
  test::SceneMaker maker;
  const std::uint32_t black = maker.material(Spectrum(0.0F)), lamp = maker.material(Spectrum(0.0F), Spectrum(5.0F));
  maker.room({black, lamp, black, black, black, black}, {-1, -1, -1}, {1, 1, 1});
  const World world(maker.take());
  RunningStatistics light;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const RadiositySolution solution = solve_radiosity(world, quick(), seed);
    light.add(light_of(solution, gather_irradiance(world, solution, 16, seed)));
  }
  expect_near(light, std::numbers::pi * 5 * 4);
}

TEST(Irradiance, HasTheSameBitsForAnyNumberOfThreads) {
  const World world(test::own_scene("cornell"));
  const RadiositySolution solution = solve_radiosity(world, quick(), 1);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return gather_irradiance(world, solution, 8, 1);
  };
  const std::vector<Irradiance> one = with(1), three = with(3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].direct, three[i].direct);
    ASSERT_EQ(one[i].indirect, three[i].indirect);
  }
}

}  // namespace
}  // namespace radfarm
