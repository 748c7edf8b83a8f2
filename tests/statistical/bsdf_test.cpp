#include "matter/bsdf.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "matter/layers.h"
#include "support/statistics.h"
#include "unit/matter/sample_matters.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kFamilyLevel = 1e-6;  // one false alarm in a million runs of this file

struct Case {
  std::string name;
  Matter matter;
  bool is_front = true;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const float roughness : {0.05F, 0.1F, 0.3F, 0.6F, 1.0F}) {
    const std::string r = std::to_string(static_cast<int>(std::lround(roughness * 100)));
    cases.push_back({"metal_" + r, test::white_metal(roughness)});
    cases.push_back({"dielectric_" + r, test::white_dielectric(roughness)});
    if (roughness < 0.1F) continue;
    cases.push_back({"thin_" + r, test::thin_glass(roughness)});
    cases.push_back({"glass_out_" + r, test::solid_glass(roughness)});
    cases.push_back({"glass_in_" + r, test::solid_glass(roughness), false});
  }
  cases.push_back({"anisotropic", test::anisotropic(0.3F, 0.7F)});
  cases.push_back({"coat_on_metal", test::coated(test::white_metal(0.6F), 0.1F)});
  cases.push_back({"coat_on_diffuse", test::coated(Matter{}, 0.3F)});
  cases.push_back({"sheen_on_diffuse", test::with_sheen(Matter{}, 0.5F)});
  cases.push_back({"all_layers", test::with_sheen(test::coated(test::thin_glass(0.4F), 0.2F), 0.3F)});
  cases.push_back({"diamond_in", test::solid_glass(0.3F, 2.4F), false});
  return cases;
}

const std::vector<Case> kCases = all_cases();
constexpr std::array kCosines = {1.0F, 0.7071068F, 0.0871557F};  // 0, 45 and 85 degrees

/// Cells over directions, even in azimuth about the mirrored viewer and dense towards the mirrored and the refracted direction in
/// the plane of incidence's polar angle: a lobe of alpha 0.0025 must not fall within one cell.
constexpr int kRows = 48, kColumns = 24, kDraws = 100'000;

/// Azimuth and polar angle are warped so that cells are narrow about the lobe: by sinh about its centre.
struct Warp {
  double center, width, low, high;  // of the angle; it runs from low to high

  double at(double s) const { return center + width * std::sinh(begin() + s * (end() - begin())); }
  double of(double angle) const { return (std::asinh((angle - center) / width) - begin()) / (end() - begin()); }
  double slope(double s) const { return width * (end() - begin()) * std::cosh(begin() + s * (end() - begin())); }
  double begin() const { return std::asinh((low - center) / width); }
  double end() const { return std::asinh((high - center) / width); }
};

struct Grid {
  Warp polar, turn;
};

double wrapped(double angle) { return angle - 2 * kPiD * std::floor(angle / (2 * kPiD)); }

Grid grid_of(const Case& c, float cosine, bool above) {
  const Matter& m = c.matter;
  const float finest = m.clearcoat > 0 ? std::min(m.roughness, m.clearcoat_roughness) : m.roughness;
  const double alpha = std::max(0.002, static_cast<double>(finest * finest) / 2);
  double polar = std::acos(static_cast<double>(cosine));
  if (!above) {
    const double eta = !c.matter.has_volume ? 1 : c.is_front ? static_cast<double>(c.matter.ior) : 1 / static_cast<double>(c.matter.ior);
    polar = kPiD - std::asin(std::min(1.0, std::sin(polar) / eta));
  }
  const double sine = std::max(std::sin(polar), alpha);
  const double low = above ? 0 : kPiD / 2;
  return {{polar, alpha, low, low + kPiD / 2}, {kPiD, std::min(3.0, alpha / sine), 0, 2 * kPiD}};
}

constexpr float kViewerTurn = 0.3F;

/// Directions of one side into cells; -1: of the other side.
int cell_of(const Grid& grid, const Vec3& i, bool above) {
  if ((i.z > 0) != above) return -1;
  const double polar = std::atan2(std::hypot(static_cast<double>(i.x), static_cast<double>(i.y)), static_cast<double>(i.z));
  const double turn = wrapped(std::atan2(static_cast<double>(i.y), static_cast<double>(i.x)) - static_cast<double>(kViewerTurn));
  const int row = std::clamp(static_cast<int>(grid.polar.of(polar) * kRows), 0, kRows - 1);
  const int column = std::clamp(static_cast<int>(grid.turn.of(turn) * kColumns), 0, kColumns - 1);
  return row * kColumns + column;
}

/// The density's integral over the cells of one side, by `parts`^2 Gauss pairs each.
std::vector<double> expected_counts(const Bsdf& bsdf, const Grid& grid, int parts) {
  std::vector<double> counts(kRows * kColumns);
  const std::array offsets = {0.5 - std::sqrt(3.0) / 6, 0.5 + std::sqrt(3.0) / 6};
  const int rows = kRows * parts, columns = kColumns * parts;
  for (int a = 0; a < 2 * rows; ++a) {
    const double s = (a / 2 + offsets[static_cast<std::size_t>(a % 2)]) / rows;
    const double polar = grid.polar.at(s);
    for (int b = 0; b < 2 * columns; ++b) {
      const double t = (b / 2 + offsets[static_cast<std::size_t>(b % 2)]) / columns;
      const double turn = grid.turn.at(t) + static_cast<double>(kViewerTurn);
      const Vec3d i(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      const double density = static_cast<double>(bsdf.pdf_specular(to_float(i))) * std::sin(polar) * grid.polar.slope(s) *
                             grid.turn.slope(t) / (4.0 * rows * columns);
      counts[static_cast<std::size_t>(a / (2 * parts) * kColumns + b / (2 * parts))] += kDraws * density;
    }
  }
  return counts;
}

class BsdfAgreesWithItsPdf : public testing::TestWithParam<std::size_t> {};

// Directions that the sampler refuses are lost: one more cell holds them, and expects what the density leaves of 1.
TEST_P(BsdfAgreesWithItsPdf, ChiSquare) {
  const Case& c = kCases[GetParam()];
  for (const float cosine : kCosines) {
    const Bsdf bsdf = test::bsdf_of(c.matter, test::towards(cosine, kViewerTurn), c.is_front);
    std::vector<double> observed, expected;
    double inside = 0;
    const std::array grids = {grid_of(c, cosine, true), grid_of(c, cosine, false)};
    for (const Grid& grid : grids) {
      const std::vector<double> side = expected_counts(bsdf, grid, 6);
      expected.insert(expected.end(), side.begin(), side.end());
    }
    for (const double count : expected) inside += count;
    observed.resize(expected.size());
    double refused = 0;
    RandomSequence random(combine(9, GetParam(), static_cast<std::uint64_t>(cosine * 100)));
    for (int k = 0; k < kDraws; ++k) {
      const float choice = random.uniform(), u = random.uniform();
      const Bsdf::Sample sample = bsdf.sample_specular(choice, {u, random.uniform()});
      if (sample.pdf == 0) {
        ++refused;
        continue;
      }
      const bool above = sample.direction.z > 0;
      const int cell = cell_of(grids[above ? 0 : 1], sample.direction, above);
      ++observed[static_cast<std::size_t>(cell + (above ? 0 : kRows * kColumns))];
    }
    ASSERT_LE(inside, kDraws * 1.001) << "the density has more than 1, at " << cosine;
    observed.push_back(refused);
    expected.push_back(std::max(0.0, kDraws - inside));
    // The quadrature's error, below 1e-3 of the whole, is not the sampler's.
    if (inside > kDraws) {
      for (double& count : expected) count *= kDraws / inside;
    }
    const test::ChiSquare result = test::chi_square(observed, expected);
    EXPECT_GT(result.p_value, test::sidak_level(kFamilyLevel, kCases.size() * kCosines.size()))
        << "at " << cosine << ": chi2 " << result.statistic << " with " << result.degrees_of_freedom << "; refused " << refused
        << " expected " << kDraws - inside;
  }
}

INSTANTIATE_TEST_SUITE_P(Bsdf, BsdfAgreesWithItsPdf, testing::Range(std::size_t{0}, kCases.size()),
                         [](const auto& test) { return kCases[test.param].name; });

/// White matter under white light. `loses`: what its form is known to lose at most (docs/materials.md).
struct Furnace {
  std::string name;
  Matter matter;
  bool is_front = true;
  double loses = 0;
};

std::vector<Furnace> furnaces() {
  std::vector<Furnace> all;
  for (const float roughness : {0.0F, 0.05F, 0.1F, 0.2F, 0.35F, 0.5F, 0.75F, 1.0F}) {
    const std::string r = std::to_string(static_cast<int>(std::lround(roughness * 100)));
    all.push_back({"metal_" + r, test::white_metal(roughness)});
    all.push_back({"dielectric_" + r, test::white_dielectric(roughness)});
    Matter half = test::white_metal(roughness);
    half.metallic = 0.5F;
    all.push_back({"half_metal_" + r, half});
    Matter white;
    white.base = Spectrum(1.0F);
    all.push_back({"coat_on_diffuse_" + r, test::coated(white, roughness)});
    all.push_back({"sheen_on_diffuse_" + r, test::with_sheen(white, roughness)});
    all.push_back({"coat_on_mirror_" + r, test::coated(test::white_metal(0), roughness)});
    all.push_back({"coat_on_metal_" + r, test::coated(test::white_metal(roughness), 0.1F), true, 0.055});
    all.push_back({"coat_on_dielectric_" + r, test::coated(test::white_dielectric(roughness), 0.1F), true, 0.02});
    all.push_back({"sheen_on_metal_" + r, test::with_sheen(test::white_metal(0.3F), roughness), true, 0.06});
    if (roughness > 0) all.push_back({"thin_" + r, test::thin_glass(roughness)});
    for (const float ior : {1.0F, 1.2F, 1.5F, 2.4F}) {
      const std::string n = std::to_string(static_cast<int>(std::lround(ior * 10)));
      all.push_back({"glass_" + n + "_out_" + r, test::solid_glass(roughness, ior)});
      all.push_back({"glass_" + n + "_in_" + r, test::solid_glass(roughness, ior), false});
    }
  }
  return all;
}

const std::vector<Furnace> kFurnaces = furnaces();

class WhiteFurnace : public testing::TestWithParam<std::size_t> {};

// 0.5 % is what the tables are made for. 2^16 even points know most albedos to 1e-3; where few of them carry much, a breach is
// looked at again with 2^20.
TEST_P(WhiteFurnace, LosesAndGainsNothing) {
  const Furnace& f = kFurnaces[GetParam()];
  for (const float cosine : {0.98F, 0.7F, 0.4F, 0.15F, 0.03F}) {
    const Bsdf bsdf = test::bsdf_of(f.matter, test::towards(cosine), f.is_front);
    double albedo = luminance(test::sampled_albedo(bsdf, 1 << 16).all());
    if (albedo < 1 - f.loses - 0.005 || albedo > 1.005) albedo = luminance(test::sampled_albedo(bsdf, 1 << 20).all());
    EXPECT_GT(albedo, 1 - f.loses - 0.005) << cosine;
    EXPECT_LT(albedo, 1.005) << cosine;
  }
}

INSTANTIATE_TEST_SUITE_P(Bsdf, WhiteFurnace, testing::Range(std::size_t{0}, kFurnaces.size()),
                         [](const auto& test) { return kFurnaces[test.param].name; });

// reflectance() is what the Bsdf scatters to the viewer's side. Matter under a coat or sheen loses what its form loses.
TEST(Reflectance, AgreesWithTheBsdf) {
  for (const Furnace& f : kFurnaces) {
    if (!f.is_front) continue;
    Matter m = f.matter;
    m.base = {0.9F, 0.5F, 0.2F};
    for (const float cosine : {0.98F, 0.5F, 0.15F}) {
      const SpectrumD above = test::sampled_albedo(test::bsdf_of(m, test::towards(cosine)), 1 << 16).above();
      const Spectrum stated = reflectance(m, cosine);
      for (const auto& [a, b] : {std::pair{above.r, stated.r}, std::pair{above.g, stated.g}, std::pair{above.b, stated.b}}) {
        EXPECT_NEAR(a, static_cast<double>(b), 0.005 + f.loses) << f.name << " at " << cosine;
      }
      EXPECT_LE(max_component(stated), 1);
    }
  }
}

TEST(Reflectance, MeanIsTheHemispheresMean) {
  constexpr int kSteps = 400;
  for (const Furnace& f : kFurnaces) {
    Matter m = f.matter;
    m.base = {0.9F, 0.5F, 0.2F};
    SpectrumD mean;
    for (int k = 0; k < kSteps; ++k) {
      const double cosine = (k + 0.5) / kSteps;
      mean += SpectrumD(reflectance(m, static_cast<float>(cosine))) * (2 * cosine / kSteps);
    }
    EXPECT_NEAR(luminance(mean), static_cast<double>(luminance(mean_reflectance(m))), 0.005) << f.name;
    EXPECT_LE(max_component(mean_reflectance(f.matter)), 1.0001F) << f.name;
  }
}

}  // namespace
}  // namespace radfarm
