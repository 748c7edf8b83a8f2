#include "senders/likely.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/polygon_irradiance.h"
#include "math/sampling.h"
#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

// fast_polygon_form_factor() errs by 1e-8 absolute and 1e-6 relative, a sum of floats by little more.
constexpr double kRelative = 1e-3;
constexpr double kFormFactorError = 1e-7;

/// Irradiance (luminance, lux) from all that lies below a sender, nothing in between.
double irradiance(const SenderTree& tree, std::uint32_t id, const Vec3& position, const Vec3& normal) {
  const SenderNode& node = tree.nodes[id];
  double sum = 0;
  for (std::uint32_t c = 0; c < node.child_count; ++c) sum += irradiance(tree, node.first_child + c, position, normal);
  if (node.patch == kNone) return sum;
  const SenderPatch& patch = tree.patches[node.patch];
  const double height = dot(to_double(patch.normal), to_double(position) - to_double(patch.vertices[0]));
  if (!(height > 0)) return 0;
  return static_cast<double>(fast_polygon_form_factor(patch.vertices, position, normal) * node.power / patch.area);
}

Vec3 random_normal(RandomSequence& random) {
  return normalize(sample_uniform_sphere({random.uniform(), random.uniform()}));
}

Vec3 random_place(const Box3& bounds, RandomSequence& random) {
  const auto along = [&](int axis) { return bounds.min[axis] + (bounds.max[axis] - bounds.min[axis]) * random.uniform(); };
  return {along(0), along(1), along(2)};
}

/// What a comparison of bound and truth found.
struct Compared {
  std::size_t lit = 0, above_bound = 0, wrongly_dark = 0;
  double worst = 0;  // irradiance / bound
};

void compare(const SenderTree& tree, std::uint32_t id, const Vec3& position, const Vec3& normal, Compared& result) {
  const SenderOutline outline = outline_of(tree, id);
  const JudgedIrradiance judged = judge_irradiance(outline, position, normal, 0);
  const double truth = irradiance(tree, id, position, normal), bound = static_cast<double>(judged.bound);
  EXPECT_LE(judged.likely, judged.bound * (1 + 1e-6F));
  EXPECT_GE(judged.likely, 0.1F * judged.bound * (1 - 1e-6F));
  if (!(truth > kFormFactorError * static_cast<double>(outline.max_radiosity))) return;
  ++result.lit;
  if (bound == 0) {
    ++result.wrongly_dark;
    return;
  }
  result.above_bound += truth > bound * (1 + kRelative);
  result.worst = std::max(result.worst, truth / bound);
}

void expect_bounded(const Compared& result) {
  EXPECT_GT(result.lit, 1000U);
  EXPECT_EQ(result.wrongly_dark, 0U) << "of " << result.lit << " are lit and judged dark";
  EXPECT_EQ(result.above_bound, 0U) << "of " << result.lit << " get more than the bound, up to " << result.worst << " times";
}

class JudgeIrradianceIn : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, JudgeIrradianceIn, testing::Values("cornell", "emitters_reflect", "room"));

TEST_P(JudgeIrradianceIn, BoundsWhatPatchesGive) {
  const SolvedScene scene(GetParam());
  RandomSequence random(1);
  Compared result;
  for (int n = 0; n < 40'000; ++n) {
    const auto id = static_cast<std::uint32_t>(random.bits() % scene.tree.nodes.size());
    if (scene.tree.nodes[id].patch == kNone) continue;
    compare(scene.tree, id, random_place(scene.world.bounds, random), random_normal(random), result);
  }
  expect_bounded(result);
}

TEST_P(JudgeIrradianceIn, BoundsWhatClustersGive) {
  const SolvedScene scene(GetParam());
  RandomSequence random(2);
  Compared result;
  for (int n = 0; n < 20'000; ++n) {
    const auto id = static_cast<std::uint32_t>(random.bits() % scene.tree.nodes.size());
    if (scene.tree.nodes[id].patch != kNone || scene.tree.nodes[id].power > 0.2F * scene.tree.nodes[0].power) continue;
    compare(scene.tree, id, random_place(scene.world.bounds, random), random_normal(random), result);
  }
  expect_bounded(result);
}

/// A tree of one triangle that sends 1 lm/m^2.
SenderTree one_patch(const TriangleVertices& vertices, bool emits) {
  SenderPatch patch;
  patch.vertices = vertices;
  patch.normal = normalize(cross(vertices[1] - vertices[0], vertices[2] - vertices[0]));
  patch.area = area_of(vertices);
  SenderNode node;
  for (const Vec3& v : vertices) node.bounds.extendBy(v);
  node.area = node.power = patch.area;
  node.max_radiosity = 1;
  (emits ? node.emitted_power : node.reflected_power) = Spectrum(patch.area);
  node.patch = 0;
  return own_sender_tree({node}, {patch});
}

TEST(JudgeIrradiance, BoundsWhatPatchesOfAnyOrientationGive) {
  // Receivers around the patch at up to about its size: where the outline says the least.
  RandomSequence random(3);
  Compared result;
  for (int n = 0; n < 20'000; ++n) {
    const Box3 unit(Vec3(-1, -1, -1), Vec3(1, 1, 1));
    const Vec3 a = random_place(unit, random), b = random_place(unit, random), c = random_place(unit, random);
    const SenderTree tree = one_patch({a, b, c}, n % 2 == 0);
    if (!(tree.patches[0].area > 0.05F)) continue;
    const Vec3 b3 = sample_uniform_triangle({random.uniform(), random.uniform()});
    const float height = std::exp(6 * random.uniform() - 4);
    const Vec3 place = a * b3.x + b * b3.y + c * b3.z + tree.patches[0].normal * height;
    compare(tree, 0, place + random_normal(random) * (random.uniform() * height), random_normal(random), result);
  }
  expect_bounded(result);
}

TEST(JudgeIrradiance, BoundsABoxSeenFromBesideIt) {
  // Six walls of a unit cube as one cluster: receivers close by, some looking almost away from it.
  SenderTree tree;
  test::SceneMaker maker;
  const std::uint32_t light = maker.material(Spectrum(), Spectrum(1.0F));
  maker.room({light, light, light, light, light, light}, {-1, -1, -1}, {1, 1, 1});
  Scene scene = maker.take();
  for (Mesh& mesh : scene.meshes) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  const World world(scene);
  RadiositySolution solution;
  const SideNumbers sides(world.scene);
  solution.hierarchy = build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
  solution.reflected_power.resize(solution.hierarchy.nodes.size());
  tree = make_sender_tree(solution);
  RandomSequence random(4);
  Compared result;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 way = random_normal(random);
    const Vec3 place = way * (1 / max_abs_component(way) * (1 + std::exp(8 * random.uniform() - 7)));
    compare(tree, 0, place, random_normal(random), result);
  }
  expect_bounded(result);
}

TEST(JudgeIrradiance, WhatReflectsNearByIsNotCounted) {
  const TriangleVertices triangle{Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1)};
  const Vec3 origin(0, 0, 0), up(0, 0, 1);
  const auto judged = [&](bool emits, float near_distance) {
    return judge_irradiance(outline_of(one_patch(triangle, emits), 0), origin, up, near_distance);
  };
  // The bounding sphere reaches from the origin to sqrt(1.5) + sqrt(0.5) = 1.932 m.
  EXPECT_EQ(judged(false, 1.94F).bound, 0);
  EXPECT_EQ(judged(false, 1.94F).likely, 0);
  EXPECT_GT(judged(false, 1.92F).bound, 0);
  EXPECT_GT(judged(true, 1.94F).bound, 0);
  EXPECT_EQ(judged(true, 1.94F).bound, judged(true, 0).bound);
}

TEST(JudgeIrradiance, LikelyKeepsToItsBoundWithNearPartsLeftOut) {
  const SolvedScene scene("cornell");
  RandomSequence random(5);
  std::size_t above = 0, lit = 0;
  float worst = 0;
  for (int n = 0; n < 40'000; ++n) {
    const auto id = static_cast<std::uint32_t>(random.bits() % scene.tree.nodes.size());
    const float near_distance = 0.01F + 0.5F * random.uniform();
    const JudgedIrradiance judged = judge_irradiance(outline_of(scene.tree, id), random_place(scene.world.bounds, random),
                                                     random_normal(random), near_distance);
    EXPECT_GE(judged.likely, 0.1F * judged.bound * (1 - 1e-6F));
    lit += judged.bound > 0;
    if (judged.likely <= judged.bound * (1 + 1e-6F)) continue;
    ++above;
    worst = std::max(worst, judged.likely / judged.bound);
  }
  EXPECT_EQ(above, 0U) << "of " << lit << ", up to " << worst << " times the bound";
}

TEST(DrawPatch, DrawsEachPatchWithTheProbabilityItStates) {
  const SolvedScene scene("cornell");
  const Vec3 place = scene.world.bounds.center(), up(0, 1, 0);
  // Along the even steps of `choice` each patch gets its share, off by at most a step at either end of it: at most one count
  // and the roundings of a float that is scaled at each level.
  constexpr int kSteps = 100'000;
  std::vector<double> drawn(scene.tree.nodes.size()), stated(scene.tree.nodes.size());
  for (int i = 0; i < kSteps; ++i) {
    const float choice = (static_cast<float>(i) + 0.5F) / kSteps;
    const DrawnPatch patch = draw_patch(scene.tree, 0, place, up, 0, choice);
    if (!(patch.probability > 0)) {
      // A cluster that looked as if it might give something, and does not.
      const float most = scene.tree.nodes[patch.node].max_radiosity;
      EXPECT_LE(irradiance(scene.tree, patch.node, place, up), kFormFactorError * static_cast<double>(most));
      continue;
    }
    ASSERT_NE(scene.tree.nodes[patch.node].patch, kNone);
    EXPECT_TRUE(stated[patch.node] == 0 || stated[patch.node] == static_cast<double>(patch.probability));
    stated[patch.node] = static_cast<double>(patch.probability);
    ++drawn[patch.node];
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i] == 0) continue;
    EXPECT_NEAR(drawn[i], kSteps * stated[i], 3) << i;
  }
}

}  // namespace
}  // namespace radfarm
