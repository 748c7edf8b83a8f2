#include "senders/reflector_lookup.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/sampling.h"
#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

/// The least of a point's three weights, times the triangle's least height: how far inside it lies, m.
double depth_inside(const TriangleVertices& v, const Vec3& position) {
  const Vec3d e1 = to_double(v[1]) - to_double(v[0]), e2 = to_double(v[2]) - to_double(v[0]);
  const Vec3d d = to_double(position) - to_double(v[0]), normal = cross(e1, e2);
  const double b = dot(cross(d, e2), normal) / dot(normal, normal), c = dot(cross(e1, d), normal) / dot(normal, normal);
  const double longest = std::max({length(e1), length(e2), length(e1 - e2)});
  return std::min({b, c, 1 - b - c}) * length(normal) / longest;
}

// Scenes of a few metres in floats: some ulps of a position.
constexpr double kRounding = 2e-6;  // m

void expect_contains(const SenderTree& tree, std::uint32_t reflector, const Hit& hit, const SurfacePoint& point) {
  ASSERT_LT(reflector, tree.reflectors.size());
  const Reflector& patch = tree.reflectors[reflector];
  EXPECT_EQ(patch.instance, hit.instance);
  EXPECT_EQ(patch.triangle, hit.triangle);
  EXPECT_EQ(patch.is_front != 0, point.is_front);
  EXPECT_GT(depth_inside(patch.vertices, point.position), -kRounding);
}

/// Whether any patch of the tree holds the point: the slow truth.
bool is_sent_from(const SenderTree& tree, const Hit& hit, const SurfacePoint& point) {
  return std::any_of(tree.reflectors.begin(), tree.reflectors.end(), [&](const Reflector& patch) {
    return patch.instance == hit.instance && patch.triangle == hit.triangle && (patch.is_front != 0) == point.is_front &&
           depth_inside(patch.vertices, point.position) > kRounding;
  });
}

class ReflectorLookupIn : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ReflectorLookupIn, testing::Values("cornell", "emitters_reflect", "sheet", "room"));

TEST_P(ReflectorLookupIn, FindsThePatchThatARayMeets) {
  const SolvedScene scene(GetParam());
  const ReflectorLookup lookup(scene.world, scene.tree);
  RandomSequence random(1);
  const auto inside = [&](int axis) {
    const float share = 0.02F + 0.96F * random.uniform();
    return scene.world.bounds.min[axis] * (1 - share) + scene.world.bounds.max[axis] * share;
  };
  std::size_t found = 0, in_parts = 0;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 origin(inside(0), inside(1), inside(2));
    const Vec3 way = normalize(sample_uniform_sphere({random.uniform(), random.uniform()}));
    const auto hit = scene.world.caster.closest({origin, way}, 1);
    if (!hit) continue;
    SurfacePoint point = scene.world.surfaces.at(*hit);
    face(point, -way);
    const std::uint32_t node = lookup.find(*hit, point);
    if (node == kNone) {
      EXPECT_FALSE(is_sent_from(scene.tree, *hit, point)) << point.position;
      continue;
    }
    expect_contains(scene.tree, node, *hit, point);
    ++found;
    const TriangleVertices whole = scene.world.surfaces.triangle(hit->instance, hit->triangle);
    in_parts += area_of(whole) > 2 * area_of(scene.tree.reflectors[node].vertices);
  }
  EXPECT_GT(found, 3000U);
  // A patch that only emits stays whole; else these scenes are cut.
  EXPECT_GT(in_parts, 100U);
}

TEST(ReflectorLookup, FindsPointsOnTheEdgesOfWholesAndParts) {
  // On an edge, rounding may put the point beyond both its neighbours.
  const SolvedScene scene("cornell");
  const ReflectorLookup lookup(scene.world, scene.tree);
  RandomSequence random(2);
  std::size_t lost = 0, tried = 0;
  for (const Reflector& patch : scene.tree.reflectors) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const float at = random.uniform();
      const Vec3 position = patch.vertices[edge] * (1 - at) + patch.vertices[(edge + 1) % 3] * at;
      const Hit hit = scene.world.surfaces.hit_at(patch.instance, patch.triangle, position);
      SurfacePoint point = scene.world.surfaces.at(hit);
      face(point, cross(patch.vertices[1] - patch.vertices[0], patch.vertices[2] - patch.vertices[0]));
      const std::uint32_t node = lookup.find(hit, point);
      ++tried;
      if (node == kNone) {
        ++lost;
        continue;
      }
      expect_contains(scene.tree, node, hit, point);
    }
  }
  EXPECT_EQ(lost, 0U) << "of " << tried;
}

/// A triangle in four parts of which only those of `sends` send.
RadiositySolution four_parts(const World& world, const std::vector<std::uint32_t>& sends) {
  RadiositySolution solution;
  solution.hierarchy = build_hierarchy(world, SideNumbers(world.scene), {true, false});
  const std::uint32_t first = subdivide(solution.hierarchy, solution.hierarchy.leaves.at(0));
  solution.reflected_power.resize(solution.hierarchy.nodes.size());
  for (const std::uint32_t part : sends) solution.reflected_power[first + part] = Spectrum(1.0F);
  pull_up(solution.hierarchy, solution.reflected_power);
  return solution;
}

TEST(ReflectorLookup, FindsNothingOnPartsThatSendNothing) {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const World world(maker.take());
  const auto found = [&](const std::vector<std::uint32_t>& sends, const Vec3& position) {
    const SenderTree tree = make_sender_tree(four_parts(world, sends));
    const Hit hit = world.surfaces.hit_at(0, 0, position);
    return ReflectorLookup(world, tree).find(hit, world.surfaces.at(hit)) != kNone;
  };
  const Vec3 in_first(0.1F, 0.1F, 0), in_second(0.8F, 0.1F, 0), in_third(0.1F, 0.8F, 0);
  EXPECT_TRUE(found({0, 1}, in_first));
  EXPECT_TRUE(found({0, 1}, in_second));
  EXPECT_FALSE(found({0, 1}, in_third));
  // One alone as well.
  EXPECT_TRUE(found({0}, in_first));
  EXPECT_FALSE(found({0}, in_second));
  EXPECT_FALSE(found({0}, in_third));
}

TEST(ReflectorLookup, TheOtherSideOfASheetIsDark) {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const World world(maker.take());
  const SenderTree tree = make_sender_tree(four_parts(world, {0, 1, 2, 3}));
  const Hit hit = world.surfaces.hit_at(0, 0, {0.2F, 0.2F, 0});
  SurfacePoint point = world.surfaces.at(hit);
  const ReflectorLookup lookup(world, tree);
  EXPECT_NE(lookup.find(hit, point), kNone);
  face(point, -point.geometric_normal);
  EXPECT_EQ(lookup.find(hit, point), kNone);
}

}  // namespace
}  // namespace radfarm
