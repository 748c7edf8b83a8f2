#include "scene/footprint.h"

#include <gtest/gtest.h>

#include "scene/camera.h"
#include "scene/ray_cone.h"

namespace radfarm {
namespace {

constexpr float kRounding = 32 * 0x1p-24F;

TEST(ConeOnPlane, IsLongerByTheSlantAlongTheRay) {
  const Vec3 normal(0, 0, 1);
  const SurfaceFootprint slanted = cone_on_plane(normal, normalize(Vec3(1, 0, -1)), 0.5F);
  EXPECT_NEAR(slanted.along.x, 0.5F * std::sqrt(2.0F), kRounding);
  EXPECT_NEAR(length(slanted.along), 0.5F * std::sqrt(2.0F), kRounding);
  EXPECT_NEAR(length(slanted.across), 0.5F, kRounding);
  EXPECT_NEAR(dot(slanted.along, slanted.across), 0, kRounding);
  const SurfaceFootprint straight = cone_on_plane(normal, -normal, 0.5F);
  EXPECT_NEAR(length(straight.along), 0.5F, kRounding);
  EXPECT_NEAR(length(straight.across), 0.5F, kRounding);
}

TEST(ToUv, ScalesByTheTriangle) {
  // 2 m to a unit of u, 4 m to one of v.
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 4, 0)};
  const std::array<Vec2, 3> uv = {Vec2(0.5F, 0.5F), Vec2(1.5F, 0.5F), Vec2(0.5F, 1.5F)};
  const UvFootprint f = to_uv({{1, 0, 0}, {0, 1, 0}}, corners, uv);
  EXPECT_NEAR(f.along.x, 0.5F, kRounding);
  EXPECT_NEAR(f.along.y, 0, kRounding);
  EXPECT_NEAR(f.across.x, 0, kRounding);
  EXPECT_NEAR(f.across.y, 0.25F, kRounding);
}

TEST(ToUv, IsAPointOnATriangleWithoutArea) {
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  EXPECT_TRUE(to_uv({{1, 0, 0}, {0, 1, 0}}, corners, {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}).is_point());
}

TEST(Moved, TakesTheLinearPartOfATransform) {
  const UvFootprint f = moved(UvFootprint{{1, 0}, {0, 1}}, {2, 3, 100, 4, 5, 100});
  EXPECT_EQ(f.along, Vec2(2, 4));
  EXPECT_EQ(f.across, Vec2(3, 5));
}

TEST(PixelCone, GrowsWithTheDistanceAndShrinksWithTheSamples) {
  Camera camera;
  const RayCone one = pixel_cone(camera, 100, camera.forward, 1), four = pixel_cone(camera, 100, camera.forward, 4);
  EXPECT_EQ(one.width, 0);
  EXPECT_GT(one.spread, 0);
  EXPECT_NEAR(four.spread, one.spread / 2, kRounding * one.spread);
  EXPECT_EQ(advance(one, 40).width, 4 * advance(one, 10).width) << "four times the distance: two levels";
  EXPECT_LT(pixel_cone(camera, 100, normalize(Vec3(1, 0, -1)), 1).spread, one.spread) << "pixels off the axis are smaller";
}

TEST(PixelCone, OfAnOrthographicCameraKeepsItsWidth) {
  Camera camera;
  camera.kind = Camera::Kind::kOrthographic;
  const RayCone cone = pixel_cone(camera, 100, camera.forward, 1);
  EXPECT_EQ(cone.width, 2 * camera.half_height / 100) << "a pixel";
  EXPECT_EQ(advance(cone, 1000).width, cone.width);
}

TEST(Scatter, MirrorsKeepAConeAndDiffuseSurfacesWidenIt) {
  const RayCone met{0.5F, 0.001F, 0.25F};
  EXPECT_EQ(scatter(met, 1, true).spread, met.spread);
  EXPECT_NEAR(scatter(met, kInversePi, false).spread, 0.25F * std::sqrt(kPi), kRounding);
  EXPECT_EQ(scatter(met, 1e9F, false).spread, met.spread) << "never narrower";
  EXPECT_EQ(scatter(met, 0, false).spread, 1) << "about a radian at most";
  EXPECT_EQ(scatter(met, 1, false).width, met.width);
}

TEST(Scatter, ALineStaysALine) { EXPECT_EQ(advance(scatter({}, kInversePi, false), 10).width, 0); }

}  // namespace
}  // namespace radfarm
