#include "scene/environment_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr int kDraws = 400'000;
constexpr int kRows = 20, kColumns = 40;
constexpr std::size_t kTests = 30;  // chi-square tests and z-tests of this file
const double kLevel = test::sidak_level(1e-6, kTests);

/// Maps whose rows and columns divide the histogram's or are divided by it, so that a cell's probability is a sum over
/// texels.
Environment map_of(std::uint32_t width, std::uint32_t height,
                   const std::function<float(std::uint32_t, std::uint32_t)>& value) {
  Environment e;
  e.width = width;
  e.height = height;
  for (std::uint32_t r = 0; r < height; ++r) {
    for (std::uint32_t c = 0; c < width; ++c) e.radiance.push_back(Spectrum(1, 0.8F, 0.5F) * value(r, c));
  }
  return e;
}

Environment with_sun(Environment e, float cos_radius, float radiance) {
  e.sun.direction = normalize(Vec3(0.3F, 0.5F, -0.7F));
  e.sun.cos_radius = cos_radius;
  e.sun.radiance = Spectrum(radiance);
  return e;
}

struct Case {
  const char* name;
  Environment environment;
};

std::vector<Case> all_cases() {
  const auto noise = [](std::uint32_t r, std::uint32_t c) { return to_unit_float(combine(5, r, c)); };
  const auto spike = [](std::uint32_t r, std::uint32_t c) { return r == 7 && c == 0 ? 1e6F : 1.0F; };
  const auto at_pole = [](std::uint32_t r, std::uint32_t c) {
    return r == 0 && c == 13 ? 100.0F : r > 30 ? 1.0F : 0.0F;
  };
  return {{"OneTexel", map_of(1, 1, [](auto, auto) { return 3.0F; })},
          {"Even", map_of(80, 40, [](auto, auto) { return 1.0F; })},
          {"Noise", map_of(80, 40, noise)},
          {"Spike", map_of(80, 40, spike)},
          {"Pole", map_of(80, 40, at_pole)},
          {"NoiseAndWideSun", with_sun(map_of(40, 20, noise), 0.9F, 5)},
          {"WideSun", with_sun({}, 0.7F, 5)}};
}
const std::vector<Case> kCases = all_cases();

std::size_t cell_of(const Vec3& way) {
  const LatLong place = latlong_of(to_double(way));
  const auto row = static_cast<std::size_t>(place.colatitude / kPiD * kRows);
  const auto column = static_cast<std::size_t>(place.longitude / (2 * kPiD) * kColumns);
  return std::min<std::size_t>(row, kRows - 1) * kColumns + std::min<std::size_t>(column, kColumns - 1);
}

/// A density's integral over the histogram's cells: even over a texel; the sun's edge needs many points.
std::vector<double> expected_counts(const std::function<double(const Vec3&)>& density) {
  constexpr int kSub = 64;
  std::vector<double> counts(kRows * kColumns);
  for (int i = 0; i < kRows * kSub; ++i) {
    const double top = kPiD * i / (kRows * kSub), bottom = kPiD * (i + 1) / (kRows * kSub);
    const double omega = (std::cos(top) - std::cos(bottom)) * 2 * kPiD / (kColumns * kSub);
    for (int j = 0; j < kColumns * kSub; ++j) {
      const Vec3d way = direction_at({2 * kPiD * (j + 0.5) / (kColumns * kSub), (top + bottom) / 2});
      counts[static_cast<std::size_t>(i / kSub * kColumns + j / kSub)] += kDraws * omega * density(to_float(way));
    }
  }
  return counts;
}

/// The totals must agree within `quadrature`, which the edge of a sun's disc needs; then they are made equal.
void expect_same(std::vector<double> observed, std::vector<double> expected, double quadrature) {
  double all = 0;
  for (const double e : expected) all += e;
  ASSERT_NEAR(all, kDraws, quadrature * kDraws) << "the pdf does not integrate to 1";
  for (double& e : expected) e *= kDraws / all;
  const test::ChiSquare result = test::chi_square(observed, expected);
  EXPECT_GT(result.p_value, kLevel) << "chi2 " << result.statistic << " with " << result.degrees_of_freedom;
}

class AnEnvironment : public testing::TestWithParam<std::size_t> {
 protected:
  const Environment& environment() const { return kCases[GetParam()].environment; }
  double quadrature() const { return is_black(environment().sun.radiance) ? 1e-5 : 2e-4; }
};
INSTANTIATE_TEST_SUITE_P(EnvironmentLight, AnEnvironment, testing::Range(std::size_t{0}, kCases.size()),
                         [](const auto& test) { return kCases[test.param].name; });

TEST_P(AnEnvironment, IsSampledByItsPdf) {
  const EnvironmentLight light(environment());
  std::vector<double> observed(kRows * kColumns);
  RunningStatistics power;
  RandomSequence random(combine(1, GetParam()));
  for (int i = 0; i < kDraws; ++i) {
    const double choice = random.uniform_double();
    const float u = random.uniform();
    const EnvironmentLight::Sample s = light.sample(choice, {u, random.uniform()});
    ++observed[cell_of(s.direction)];
    ASSERT_GT(s.pdf, 0);
    power.add(static_cast<double>(luminance(s.radiance) / s.pdf));
  }
  expect_same(observed, expected_counts([&](const Vec3& way) { return static_cast<double>(light.pdf(way)); }),
              quadrature());
  const double total = static_cast<double>(luminance(light.total()));
  // An even map has no noise but that of floats.
  if (power.standard_error() < 1e-7 * total) {
    EXPECT_NEAR(power.mean(), total, 1e-5 * total);
  } else {
    EXPECT_GT(test::z_test(power.mean(), power.standard_error(), total), kLevel)
        << power.mean() << " should be " << total;
  }
}

TEST_P(AnEnvironment, EachPatchIsSampledByItsPdfAndBringsItsLight) {
  const EnvironmentLight light(environment());
  const auto patches = light.patches();
  RandomSequence random(combine(2, GetParam()));
  double worst = 0;  // standard errors off
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    RunningStatistics irradiance;
    for (int i = 0; i < 2'000; ++i) {
      const float u = random.uniform();
      const EnvironmentLight::Sample s = light.sample_patch(p, {u, random.uniform()});
      ASSERT_GT(s.pdf, 0);
      irradiance.add(static_cast<double>(luminance(s.radiance) / s.pdf));
    }
    const double truth = static_cast<double>(luminance(patches[p].irradiance));
    const double off = irradiance.mean() - truth, sigma = irradiance.standard_error() + 1e-6 * truth;
    worst = std::max(worst, std::fabs(off) / sigma);
  }
  EXPECT_GT(2 * (1 - normal_cdf(worst)), test::sidak_level(kLevel, patches.size()));
}

TEST(EnvironmentLightPatches, AreSampledEvenlyInTheirTexels) {
  // The texels of one patch of an uneven map, counted.
  const Environment environment = map_of(360, 180, [](auto r, auto c) { return to_unit_float(combine(6, r, c)); });
  const EnvironmentLight light(environment);
  const LatLongMap map(environment);
  std::uint32_t patch = 0;
  while (light.patches()[patch].texels.row_begin < 60 || light.patches()[patch].texels.row_begin > 90) ++patch;
  const TexelRect& rect = light.patches()[patch].texels;
  const std::size_t columns = rect.column_end - rect.column_begin, rows = rect.row_end - rect.row_begin;
  std::vector<double> observed(rows * columns), expected(rows * columns);
  double total = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const LatLongMap::Texel texel{rect.row_begin + static_cast<std::uint32_t>(i / columns),
                                  rect.column_begin + static_cast<std::uint32_t>(i % columns)};
    total += expected[i] = luminance(map.integral(texel));
  }
  for (double& e : expected) e *= kDraws / total;
  RandomSequence random(3);
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    const auto texel = map.texel_at(latlong_of(to_double(light.sample_patch(patch, {u, random.uniform()}).direction)));
    // Rounding of a direction to floats may step over the patch's edge.
    const auto row = std::clamp(texel.row, rect.row_begin, rect.row_end - 1) - rect.row_begin;
    const auto column = std::clamp(texel.column, rect.column_begin, rect.column_end - 1) - rect.column_begin;
    ++observed[row * columns + column];
  }
  ASSERT_GT(expected.size(), 50U);
  EXPECT_GT(test::chi_square(observed, expected).p_value, kLevel);
}

TEST(EnvironmentLightSun, OfHalfADegreeIsSampledEvenlyOverItsDisc) {
  const Environment environment = with_sun({}, static_cast<float>(std::cos(0.2665 / 180 * kPiD)), 1.6e9F);
  const EnvironmentLight light(environment);
  const Vec3d axis = normalize(to_double(environment.sun.direction)), x = normalize(cross(axis, Vec3d(0, 1, 0))),
              y = cross(axis, x);
  const double height = 1 - static_cast<double>(environment.sun.cos_radius), sine = std::sqrt(height * (2 - height));
  std::vector<double> observed(200), expected(200, kDraws / 200.0);
  RandomSequence random(4);
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    const EnvironmentLight::Sample s = light.sample(random.uniform_double(), {u, random.uniform()});
    const double across = dot(to_double(s.direction), x) / sine, up = dot(to_double(s.direction), y) / sine;
    const double ring = std::min(across * across + up * up, 1 - 1e-9), turn = std::atan2(up, across) / (2 * kPiD) + 0.5;
    ++observed[static_cast<std::size_t>(ring * 10) * 20 +
               std::min<std::size_t>(19, static_cast<std::size_t>(turn * 20))];
    EXPECT_NEAR(static_cast<double>(s.pdf) * 2 * kPiD * height, 1, 1e-6);
    EXPECT_EQ(s.radiance, environment.sun.radiance);
  }
  EXPECT_GT(test::chi_square(observed, expected).p_value, kLevel);
}

TEST(EnvironmentLightPdf, AWrongOneIsFound) {
  const EnvironmentLight light(kCases[2].environment);
  const std::vector<double> even = expected_counts([](const Vec3&) { return 1 / (4 * kPiD); });
  std::vector<double> observed(kRows * kColumns);
  RandomSequence random(5);
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    ++observed[cell_of(light.sample(random.uniform_double(), {u, random.uniform()}).direction)];
  }
  EXPECT_LT(test::chi_square(observed, even).p_value, 1e-9);
}

}  // namespace
}  // namespace radfarm
