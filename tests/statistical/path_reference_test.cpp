#include "estimate/path_reference.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "estimate/pixel_sums.h"
#include "math/sampling.h"
#include "math/statistics.h"
#include "scene/camera.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

using test::own_scene;
using test::SceneMaker;

// One false alarm in a million runs of this file, over its z-tests.
constexpr std::size_t kTests = 12;
const double kLevel = test::sidak_level(1e-6, kTests);

/// Independent estimates, one a pixel: their statistics by part, and that none had to be dropped.
struct Estimate {
  std::array<RunningStatistics, 3> channel;  // of all light
  RunningStatistics luminous, direct, indirect;
  PixelSums sums;

  void add(const RadianceParts& parts, double weight = 1) {
    sums.add(parts);
    const SpectrumD all = SpectrumD(parts.emission) + SpectrumD(parts.reflected());
    channel[0].add(weight * all.r);
    channel[1].add(weight * all.g);
    channel[2].add(weight * all.b);
    luminous.add(weight * luminance(all));
    direct.add(luminance(SpectrumD(parts.direct)));
    indirect.add(luminance(SpectrumD(parts.indirect)));
  }
};

PixelSampler sampler_of(std::uint64_t seed, int i) { return {seed, Stream::kRender, i, 0, 0}; }

/// Estimates of the radiance along one ray.
Estimate along(const World& world, const Ray& ray, int samples, std::uint64_t seed) {
  Estimate estimate;
  Counters counters;
  for (int i = 0; i < samples; ++i) estimate.add(trace_path(world, ray, sampler_of(seed, i), counters));
  EXPECT_EQ(estimate.sums.dropped, 0U);
  return estimate;
}

void expect_mean(const RunningStatistics& measured, double truth) {
  EXPECT_GT(test::z_test(measured.mean(), measured.standard_error(), truth), kLevel)
      << measured.mean() << " +- " << measured.standard_error() << ", should be " << truth;
}

TEST(TracePath, AWhiteFurnaceIsTwoEverywhere) {
  const World world(own_scene("furnace"));
  Estimate estimate;
  Counters counters;
  for (int i = 0; i < 40000; ++i) {
    const PixelSampler sampler = sampler_of(11, i);
    const Ray ray{{0.1F, 0.05F, 0.2F}, normalize(sample_uniform_sphere(sampler.two(0)))};
    const RadianceParts parts = trace_path(world, ray, sampler, counters);
    EXPECT_EQ(parts.emission, Spectrum(1.0F));
    estimate.add(parts);
  }
  EXPECT_EQ(estimate.sums.dropped, 0U);
  expect_mean(estimate.luminous, 2);    // L_e / (1 - rho)
  expect_mean(estimate.direct, 0.5);    // rho L_e
  expect_mean(estimate.indirect, 0.5);  // the rest of the series
}

TEST(TracePath, WallsThatAllSendTheSameSeeTheSame) {
  // L_e = 3 (1 - rho), with another rho for each wall and channel, makes L = 3 everywhere.
  SceneMaker maker;
  std::vector<std::uint32_t> walls;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<float>(i);
    const Spectrum rho(0.1F + 0.15F * k, 0.9F - 0.1F * k, 0.3F + 0.05F * k);
    walls.push_back(maker.material(rho, (Spectrum(1.0F) - rho) * 3.0F));
  }
  const World world(maker.room(walls, {-1, -0.5F, -1}, {1, 0.5F, 1}).take());
  Estimate estimate;
  Counters counters;
  for (int i = 0; i < 40000; ++i) {
    const PixelSampler sampler = sampler_of(12, i);
    const Ray ray{{0.3F, 0.1F, -0.2F}, normalize(sample_uniform_sphere(sampler.two(0)))};
    estimate.add(trace_path(world, ray, sampler, counters));
  }
  EXPECT_EQ(estimate.sums.dropped, 0U);
  for (const RunningStatistics& channel : estimate.channel) expect_mean(channel, 3);
}

TEST(TracePath, APointLightFollowsTheInverseSquareLaw) {
  const Scene scene = own_scene("point_light");
  const Vec3 origin = to_float(scene.origin);
  const World world(scene);
  for (const float x : {0.0F, 0.5F, 1.5F, 3.0F, 4.5F}) {
    const Ray ray{Vec3(x, 1, 0.25F) - origin, {0, -1, 0}};
    const Estimate estimate = along(world, ray, 100, 13);
    const double squared = 4.0 + static_cast<double>(x) * static_cast<double>(x) + 0.0625;
    const double truth = 0.5 / std::numbers::pi * 100 * 2 / (squared * std::sqrt(squared));
    // No noise: a convex scene without other light. 1e-5 is a hundred float roundings.
    EXPECT_NEAR(estimate.luminous.mean() / truth, 1, 1e-5) << x;
    EXPECT_LE(estimate.luminous.variance(), 1e-10 * truth * truth);
    EXPECT_EQ(estimate.indirect.mean(), 0);
  }
}

TEST(TracePath, ARectangularLightGivesItsFormFactor) {
  SceneMaker maker;
  const std::uint32_t floor = maker.material(Spectrum(0.6F)), light = maker.material(Spectrum(), Spectrum(7.0F));
  maker.polygon(floor, {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}});
  maker.polygon(light, {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}});
  const World world(maker.take());
  // ALGORITHMS O5: below the centre of 2 x 2 at height 1; below its corner X = Y = 2.
  const double corner = 2 * 2 / std::sqrt(5.0) * std::atan(2 / std::sqrt(5.0)) / (2 * std::numbers::pi);
  for (const auto& [place, factor] : {std::pair(0.0F, 0.5541264240), std::pair(1.0F, corner)}) {
    const Ray ray{{place, 0.5F, place}, {0, -1, 0}};
    const Estimate estimate = along(world, ray, 100000, 14);
    expect_mean(estimate.direct, 0.6 * 7 * factor);
    EXPECT_EQ(estimate.indirect.mean(), 0);
    EXPECT_EQ(estimate.sums.emission, SpectrumD());
  }
}

TEST(TracePath, NothingLeaksThroughASheet) {
  const World world(own_scene("sheet"));
  const Camera camera = world.scene.cameras.at(0);
  Counters counters;
  PixelSums sums;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const PixelSampler sampler(15, Stream::kRender, x, y, 0);
      const Ray ray = camera_ray(camera, 64, 48, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      sums.add(trace_path(world, ray, sampler, counters));
    }
  }
  EXPECT_EQ(sums.dropped, 0U);
  EXPECT_EQ(sums.emission + sums.direct + sums.indirect, SpectrumD());
}

/// A point chosen uniformly by area on the fronts of a scene, and what its front meets.
struct SurfaceSample {
  Ray ray;
  Spectrum reflectance;
};

SurfaceSample sample_front(const World& world, const DiscreteDistribution& by_area, const std::vector<Hit>& triangles,
                           std::uint64_t key) {
  RandomSequence random(key);
  Hit hit = triangles[by_area.sample(random.uniform_double()).index];
  const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
  hit.u = b.y, hit.v = b.z;
  const SurfacePoint point = world.surfaces.at(hit);
  const Vec3 local = sample_cosine_hemisphere({random.uniform(), random.uniform()});
  return {{leave(point), normalize(Frame(point.geometric_normal).to_world(local))}, world.surfaces.reflectance(point)};
}

TEST(TracePath, AClosedBoxAbsorbsWhatItsReflectingEmittersSend) {
  // absorbed = pi A mean (1 - rho) L over points by area and cosine-distributed directions = emitted, in each channel.
  const World world(own_scene("emitters_reflect"));
  std::vector<double> areas;
  std::vector<Hit> triangles;
  SpectrumD emitted;
  double area = 0;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const Mesh& mesh = world.scene.meshes[world.scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const TriangleVertices v = world.surfaces.triangle(i, t);
      areas.push_back(length(cross(to_double(v[1] - v[0]), to_double(v[2] - v[0]))) / 2);
      triangles.push_back({i, t, 0, 0, 0});
      area += areas.back();
      emitted += SpectrumD(world.scene.materials[mesh.material].emission) * (std::numbers::pi * areas.back());
    }
  }
  ASSERT_NEAR(area, 16, 1e-5);
  const DiscreteDistribution by_area(areas);
  std::array<RunningStatistics, 3> absorbed;
  Counters counters;
  PixelSums sums;
  for (int i = 0; i < 60000; ++i) {
    const SurfaceSample from = sample_front(world, by_area, triangles, combine(16, static_cast<std::uint64_t>(i)));
    const RadianceParts parts = trace_path(world, from.ray, sampler_of(16, i), counters);
    sums.add(parts);
    const SpectrumD arrives(parts.emission + parts.reflected());
    const SpectrumD kept = (SpectrumD(1.0) - SpectrumD(from.reflectance)) * arrives * (std::numbers::pi * area);
    absorbed[0].add(kept.r);
    absorbed[1].add(kept.g);
    absorbed[2].add(kept.b);
  }
  EXPECT_EQ(sums.dropped, 0U);
  expect_mean(absorbed[0], emitted.r);
  expect_mean(absorbed[1], emitted.g);
  expect_mean(absorbed[2], emitted.b);
}

TEST(TracePath, TwoSeedsAgree) {
  const World world(own_scene("emitters_reflect"));
  const Camera camera = world.scene.cameras.at(0);
  const Ray ray = camera_ray(camera, 2, 2, 1, 1);
  const Estimate a = along(world, ray, 40000, 17), b = along(world, ray, 40000, 18);
  EXPECT_NE(a.luminous.mean(), b.luminous.mean());
  const double error = std::hypot(a.luminous.standard_error(), b.luminous.standard_error());
  EXPECT_GT(test::z_test(a.luminous.mean() - b.luminous.mean(), error, 0), kLevel);
}

TEST(TracePath, IsAFunctionOfItsRandomNumbers) {
  const World world(own_scene("cornell"));
  const Ray ray = camera_ray(world.scene.cameras.at(0), 2, 2, 1, 1.5F);
  Counters first, second;
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(trace_path(world, ray, sampler_of(19, i), first), trace_path(world, ray, sampler_of(19, i), second));
  }
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace radfarm
