#include "scene/surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/sampling.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

// Positions of up to 4 m go through a few roundings of floats, the inverse back through doubles: 8 ulps of the largest.
constexpr float kRounding = 4 * 8 * 0x1p-24F;

/// An oblique quad, placed as it is, turned and stretched, and mirrored.
Scene three_quads() {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0.5F}, {1, 0.1F, 0}, {1.2F, 1, 0.3F}, {-0.1F, 0.9F, 0.8F}});
  Scene scene = maker.take();
  Instance turned = scene.instances[0], mirrored = scene.instances[0];
  turned.to_world = Matrix4(0, 2, 0, 0, -1, 0, 0.5F, 0, 0, 0, 3, 0, 0.5F, -1, 0.25F, 1);
  mirrored.to_world = Matrix4(-1.5F, 0, 0, 0, 0, 1, 0.25F, 0, 0, 0, 1, 0, 0.5F, 1, -1, 1);
  scene.instances.insert(scene.instances.end(), {turned, mirrored});
  return scene;
}

TEST(Surfaces, HitAtInvertsAt) {
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  ASSERT_FALSE(surfaces.is_mirrored(1));
  ASSERT_TRUE(surfaces.is_mirrored(2));
  RandomSequence random(1);
  for (int n = 0; n < 20'000; ++n) {
    const auto instance = static_cast<std::uint32_t>(n % 3), triangle = static_cast<std::uint32_t>(n / 3 % 2);
    const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
    const Hit hit{instance, triangle, b.y, b.z, 0};
    const Vec3 position = surfaces.at(hit).position;
    const Hit again = surfaces.hit_at(instance, triangle, position);
    EXPECT_EQ(again.instance, instance);
    EXPECT_EQ(again.triangle, triangle);
    EXPECT_LT(length(surfaces.at(again).position - position), kRounding);
    // Triangles of about 1 m: weights round as positions do.
    EXPECT_NEAR(again.u, hit.u, 4 * kRounding);
    EXPECT_NEAR(again.v, hit.v, 4 * kRounding);
  }
}

TEST(Surfaces, HitAtFindsTheVertices) {
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  for (std::uint32_t instance = 0; instance < 3; ++instance) {
    for (const Vec3& vertex : surfaces.triangle(instance, 1)) {
      EXPECT_LT(length(surfaces.at(surfaces.hit_at(instance, 1, vertex)).position - vertex), kRounding);
    }
  }
}

TEST(Surfaces, HitAtStaysInTheTriangle) {
  // Of a position beside the triangle, whichever edge or corner it lies beyond.
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  RandomSequence random(2);
  std::size_t outside = 0;
  float worst = 0;
  for (int n = 0; n < 3'000; ++n) {
    const auto instance = static_cast<std::uint32_t>(n % 3);
    const TriangleVertices v = surfaces.triangle(instance, 0);
    const float b = 4 * random.uniform() - 1.5F, c = 4 * random.uniform() - 1.5F;
    const Hit hit = surfaces.hit_at(instance, 0, v[0] * (1 - b - c) + v[1] * b + v[2] * c);
    EXPECT_GE(hit.u, 0);
    EXPECT_GE(hit.v, 0);
    outside += hit.u + hit.v > 1 + 0x1p-22F;
    worst = std::max(worst, hit.u + hit.v);
  }
  EXPECT_EQ(outside, 0U) << "u + v up to " << worst;
}

}  // namespace
}  // namespace radfarm
