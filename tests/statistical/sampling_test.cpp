#include "math/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kFamilyLevel = 1e-6;  // one false alarm in a million runs of this file
constexpr int kRows = 20, kColumns = 40, kSubcells = 4, kDraws = 400'000;

struct Point {
  double s, t;
};

/// A sampler and its pdf in coordinates (s, t) of the unit square: `density` is the pdf times the area, or solid angle, that
/// a unit of the square covers there. The sampler is right when its histogram agrees with density's integral over the cells.
struct Sampler {
  std::string name;
  std::function<Point(const Vec2& u)> sample;
  std::function<double(double s, double t)> density;
};

double turn(double y, double x) {
  const double part = std::atan2(y, x) / (2 * kPiD);
  return part - std::floor(part);
}

Point on_sphere(const Vec3& p) {
  return {(static_cast<double>(p.z) + 1) / 2, turn(static_cast<double>(p.y), static_cast<double>(p.x))};
}

Vec3 direction_at(double s, double t) {
  const double z = 2 * s - 1;
  const double r = std::sqrt(1 - z * z);
  return to_float(Vec3d(r * std::cos(2 * kPiD * t), r * std::sin(2 * kPiD * t), z));
}

Point on_triangle(const Vec3& barycentrics) {
  const double b0 = static_cast<double>(barycentrics.x);
  const double b1 = static_cast<double>(barycentrics.y);
  const double b2 = static_cast<double>(barycentrics.z);
  return {1 - b0, b1 / std::max(b1 + b2, 1e-300)};
}

struct Triangle {
  std::string name;
  std::array<Vec3d, 3> vertices;  // seen from the origin
};
const std::array kTriangles = {
    Triangle{"octant", {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}},
    Triangle{"oblique", {Vec3d(-1, 0.2, 0.4), Vec3d(2, 0.1, 1), Vec3d(0, 3, 0.5)}},
    Triangle{"sliver", {Vec3d(-1, 0, 1), Vec3d(1, 0, 1), Vec3d(0, 0.01, 1)}},
    Triangle{"smallest", {Vec3d(0, 0, 1), Vec3d(0.025, 0, 1), Vec3d(0, 0.025, 1)}},
    Triangle{"wide", {Vec3d(-6, -6, 1), Vec3d(6, -6, 1), Vec3d(0, 9, 1)}},
};

/// Density over the plane's (s, t): per steradian times dw/dA = cos/d^2 times dA = 2 area s ds dt.
Sampler spherical_triangle(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  const SphericalTriangle sampler(v[0], v[1], v[2], Vec3d(0));
  return {"spherical_triangle_" + triangle.name,
          [sampler](const Vec2& u) { return on_triangle(sampler.sample(u).barycentrics); },
          [sampler, v](double s, double t) {
            const Vec3d p = v[0] * (1 - s) + v[1] * (s * t) + v[2] * (s * (1 - t));
            const Vec3d area_normal = cross(v[1] - v[0], v[2] - v[0]);  // twice the area long
            const double distance = length(p);
            return std::fabs(dot(p, area_normal)) / (distance * distance * distance) * s / sampler.solid_angle();
          }};
}

std::vector<Sampler> all_samplers() {
  constexpr float kArea = 3;
  std::vector<Sampler> samplers = {
      {"uniform_disk",
       [](const Vec2& u) {
         const Vec2 p = sample_uniform_disk(u);
         return Point{static_cast<double>(p.length2()), turn(static_cast<double>(p.y), static_cast<double>(p.x))};
       },
       [](double s, double t) {
         const double r = std::sqrt(s);
         const Vec2 p(static_cast<float>(r * std::cos(2 * kPiD * t)), static_cast<float>(r * std::sin(2 * kPiD * t)));
         return kPiD * static_cast<double>(pdf_uniform_disk(p));
       }},
      {"cosine_hemisphere", [](const Vec2& u) { return on_sphere(sample_cosine_hemisphere(u)); },
       [](double s, double t) { return 4 * kPiD * static_cast<double>(pdf_cosine_hemisphere(direction_at(s, t))); }},
      {"uniform_hemisphere", [](const Vec2& u) { return on_sphere(sample_uniform_hemisphere(u)); },
       [](double s, double t) { return 4 * kPiD * static_cast<double>(pdf_uniform_hemisphere(direction_at(s, t))); }},
      {"uniform_sphere", [](const Vec2& u) { return on_sphere(sample_uniform_sphere(u)); },
       [](double, double) { return 4 * kPiD * static_cast<double>(pdf_uniform_sphere()); }},
      {"uniform_triangle", [](const Vec2& u) { return on_triangle(sample_uniform_triangle(u)); },
       [](double s, double) { return static_cast<double>(pdf_uniform_triangle(kArea) * kArea) * 2 * s; }},
  };
  for (const Triangle& triangle : kTriangles) samplers.push_back(spherical_triangle(triangle));
  return samplers;
}

const std::vector<Sampler> kSamplers = all_samplers();

std::vector<double> observed_counts(const Sampler& sampler) {
  std::vector<double> counts(kRows * kColumns);
  RandomSequence random(20240229);
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    const Point p = sampler.sample({u, random.uniform()});
    const int row = std::clamp(static_cast<int>(p.s * kRows), 0, kRows - 1);
    const int column = std::clamp(static_cast<int>(p.t * kColumns), 0, kColumns - 1);
    ++counts[static_cast<std::size_t>(row * kColumns + column)];
  }
  return counts;
}

/// The density's integral over each cell, by two Gauss points a side of each subcell.
std::vector<double> expected_counts(const Sampler& sampler) {
  std::vector<double> counts(kRows * kColumns);
  const std::array offsets = {0.5 - std::sqrt(3.0) / 6, 0.5 + std::sqrt(3.0) / 6};
  constexpr double kWeight = static_cast<double>(kDraws) / (4.0 * kRows * kColumns * kSubcells * kSubcells);
  for (int i = 0; i < 2 * kRows * kSubcells; ++i) {
    for (int j = 0; j < 2 * kColumns * kSubcells; ++j) {
      const double s = (i / 2 + offsets[static_cast<std::size_t>(i % 2)]) / (kRows * kSubcells);
      const double t = (j / 2 + offsets[static_cast<std::size_t>(j % 2)]) / (kColumns * kSubcells);
      const int cell = i / (2 * kSubcells) * kColumns + j / (2 * kSubcells);
      counts[static_cast<std::size_t>(cell)] += kWeight * sampler.density(s, t);
    }
  }
  return counts;
}

class SamplerAgreesWithItsPdf : public testing::TestWithParam<std::size_t> {};

TEST_P(SamplerAgreesWithItsPdf, ChiSquare) {
  const Sampler& sampler = kSamplers[GetParam()];
  const test::ChiSquare result = test::chi_square(observed_counts(sampler), expected_counts(sampler));
  EXPECT_GT(result.p_value, test::sidak_level(kFamilyLevel, kSamplers.size() + 1))
      << "chi2 " << result.statistic << " with " << result.degrees_of_freedom << " degrees of freedom";
}

INSTANTIATE_TEST_SUITE_P(Sampling, SamplerAgreesWithItsPdf, testing::Range(std::size_t{0}, kSamplers.size()),
                         [](const auto& test) { return kSamplers[test.param].name; });

TEST(Sampling, WrongPdfIsFound) {
  Sampler wrong = kSamplers[1];  // cosine samples held to the uniform pdf
  wrong.density = kSamplers[2].density;
  EXPECT_LT(test::chi_square(observed_counts(wrong), expected_counts(wrong)).p_value, 1e-9);
}

TEST(Sampling, DiscreteDistributionAgreesWithItsProbabilities) {
  const std::vector<double> weights = {0, 1, 3, 0, 0, 0.5, 1e-3, 20, 7, 0};
  const DiscreteDistribution distribution(weights);
  std::vector<double> observed(weights.size()), expected(weights.size());
  RandomSequence random(7);
  for (int i = 0; i < kDraws; ++i) ++observed[distribution.sample(random.uniform_double()).index];
  for (std::size_t i = 0; i < weights.size(); ++i) expected[i] = kDraws * distribution.probability(i);
  const test::ChiSquare result = test::chi_square(observed, expected);
  EXPECT_GT(result.p_value, test::sidak_level(kFamilyLevel, kSamplers.size() + 1));
}

}  // namespace
}  // namespace radfarm
