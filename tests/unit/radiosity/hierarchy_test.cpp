#include "radiosity/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

// Areas are sums of up to a few thousand floats.
constexpr double kSum = 1e-4;

Hierarchy all_sides(const World& world) {
  const SideNumbers sides(world.scene);
  return build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
}

class HierarchyOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, HierarchyOf, testing::Values("furnace", "plates", "cornell", "room"));

TEST_P(HierarchyOf, HasEverySideOnceAsALeaf) {
  const World world(test::own_scene(GetParam()));
  const Hierarchy h = all_sides(world);
  const SideNumbers sides(world.scene);
  ASSERT_EQ(h.leaves.size(), sides.count);
  std::set<std::uint32_t> patches, nodes;
  for (const std::uint32_t leaf : h.leaves) {
    EXPECT_FALSE(h.nodes[leaf].is_cluster());
    EXPECT_EQ(h.nodes[leaf].child_count, 0U);
    nodes.insert(leaf);
    patches.insert(h.nodes[leaf].patch);
  }
  EXPECT_EQ(nodes.size(), sides.count);
  EXPECT_EQ(patches.size(), sides.count);
  EXPECT_EQ(h.nodes.size(), 2 * h.leaves.size() - 1);
}

TEST_P(HierarchyOf, SumsUpItsChildren) {
  const World world(test::own_scene(GetParam()));
  const Hierarchy h = all_sides(world);
  for (std::uint32_t i = 0; i < h.nodes.size(); ++i) {
    const Node& node = h.nodes[i];
    if (node.child_count == 0) continue;
    double area = 0;
    SpectrumD emitted;
    std::uint32_t leaves = 0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      const Node& child = h.nodes[c];
      ASSERT_GT(c, i);
      EXPECT_EQ(child.parent, i);
      area += static_cast<double>(child.area);
      emitted += SpectrumD(child.emitted_power);
      leaves += child.leaf_count;
      Box3 both = node.bounds;
      both.extendBy(child.bounds);
      EXPECT_EQ(both, node.bounds);
    }
    EXPECT_NEAR(static_cast<double>(node.area), area, kSum * area);
    EXPECT_NEAR(luminance(SpectrumD(node.emitted_power)), luminance(emitted), kSum * luminance(emitted));
    EXPECT_EQ(leaves, node.leaf_count);
  }
  EXPECT_NEAR(h.area_before.back(), static_cast<double>(h.nodes[0].area), kSum * h.area_before.back());
}

TEST_P(HierarchyOf, KeepsEveryNormalInItsNodesCone) {
  const World world(test::own_scene(GetParam()));
  const Hierarchy h = all_sides(world);
  for (const Node& node : h.nodes) {
    if (node.cone_cosine <= -1) continue;
    for (std::uint32_t leaf = node.first_leaf; leaf < node.first_leaf + node.leaf_count; ++leaf) {
      const Vec3 normal = h.patches[h.nodes[h.leaves[leaf]].patch].normal;
      EXPECT_GE(dot(normal, node.cone_axis), node.cone_cosine - 1e-5F);
    }
  }
}

/// Triangles of random orientation in a slab before the wall z = 0.
void add_leaves(test::SceneMaker& maker, std::uint32_t material, std::uint64_t seed) {
  RandomSequence random(seed);
  for (int i = 0; i < 200; ++i) {
    const Vec3 at(2 * random.uniform(), 2 * random.uniform(), 0.02F + 0.5F * random.uniform());
    const auto off = [&] { return at + Vec3(random.uniform(), random.uniform(), random.uniform()) * 0.1F; };
    maker.polygon(material, {at, off(), off()});
  }
}

TEST(Hierarchy, KeepsAWallOfManyTrianglesApartFromTheLeavesBeforeIt) {
  constexpr std::uint32_t kCells = 20;
  test::SceneMaker maker;
  const std::uint32_t grey = maker.material(Spectrum(0.5F, 0.5F, 0.5F));
  std::vector<Vec3> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {  // each cell has corners of its own: places are shared, indices are not
      const auto first = static_cast<std::uint32_t>(corners.size());
      const auto corner = [&](std::uint32_t x, std::uint32_t y) {
        corners.push_back({0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0});
      };
      corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1);
      triangles.push_back({first, first + 1, first + 2});
      triangles.push_back({first, first + 2, first + 3});
    }
  }
  maker.mesh(grey, corners, triangles);
  add_leaves(maker, grey, 4);
  const World world(maker.take());
  const Hierarchy h = all_sides(world);
  const auto is_wall = [&](const Node& node) {
    if (node.leaf_count != 2 * kCells * kCells) return false;
    for (std::uint32_t i = node.first_leaf; i < node.first_leaf + node.leaf_count; ++i) {
      const Patch& patch = h.patches[h.nodes[h.leaves[i]].patch];
      if (patch.instance != 0 || patch.is_front == 0) return false;
    }
    return true;
  };
  EXPECT_EQ(std::count_if(h.nodes.begin(), h.nodes.end(), is_wall), 1);
}

TEST(Hierarchy, LeavesOutWhatNoLightReaches) {
  const World world(test::own_scene("furnace"));
  const SideNumbers sides(world.scene);
  std::vector<bool> fronts(sides.count);
  for (std::uint32_t s = 0; s < sides.count; s += 2) fronts[s] = true;
  EXPECT_EQ(build_hierarchy(world, sides, fronts).leaves.size(), sides.count / 2);
  EXPECT_TRUE(build_hierarchy(world, sides, std::vector<bool>(sides.count)).nodes.empty());
}

TEST(Hierarchy, SubdivisionKeepsAreaPowerPlaneAndWinding) {
  const World world(test::own_scene("emitters_reflect"));
  Hierarchy h = all_sides(world);
  const std::uint32_t leaf = h.leaves[3];
  const Node before = h.nodes[leaf];
  const std::uint32_t first = subdivide(h, leaf);
  ASSERT_EQ(h.nodes[leaf].child_count, 4U);
  ASSERT_EQ(h.nodes[leaf].first_child, first);
  double area = 0, power = 0;
  for (std::uint32_t c = first; c < first + 4; ++c) {
    const Patch& part = h.patches[h.nodes[c].patch];
    area += static_cast<double>(h.nodes[c].area);
    power += luminance(SpectrumD(h.nodes[c].emitted_power));
    const TriangleVertices& v = part.vertices;
    EXPECT_GT(dot(cross(v[1] - v[0], v[2] - v[0]), part.normal), 0);
    EXPECT_EQ(h.nodes[c].parent, leaf);
  }
  EXPECT_NEAR(area, static_cast<double>(before.area), 1e-6 * area);
  EXPECT_NEAR(power, luminance(SpectrumD(before.emitted_power)), 1e-6 * power);
}

/// How far inside a triangle a point of its plane lies: the least of its three weights.
double depth_inside(const TriangleVertices& v, const Vec3& position) {
  const Vec3d e1 = to_double(v[1]) - to_double(v[0]), e2 = to_double(v[2]) - to_double(v[0]);
  const Vec3d d = to_double(position) - to_double(v[0]), normal = cross(e1, e2);
  const double b = dot(cross(d, e2), normal) / dot(normal, normal), c = dot(cross(e1, d), normal) / dot(normal, normal);
  return std::min({b, c, 1 - b - c});
}

TEST(Hierarchy, FindsThePartAPointLiesIn) {
  const World world(test::own_scene("cornell"));
  Hierarchy h = all_sides(world);
  RandomSequence random(6);
  for (const std::uint32_t leaf : std::vector(h.leaves)) {
    EXPECT_EQ(part_at(h, leaf, h.patches[h.nodes[leaf].patch].vertices[1]), leaf);
    // Each part in turn is cut again, and one of its own parts once more.
    const std::uint32_t first = subdivide(h, leaf), cut = first + leaf % 4, second = subdivide(h, cut);
    subdivide(h, second + (leaf / 4) % 4);
    std::set<std::uint32_t> found;
    for (int n = 0; n < 2000; ++n) {
      const NodeSample s = sample_node(h, h.nodes[leaf], SampleBy::kArea, 0, {random.uniform(), random.uniform()});
      const std::uint32_t part = part_at(h, leaf, s.position);
      ASSERT_EQ(h.nodes[part].child_count, 0U);
      // Positions and vertices are floats of about 1 m, parts down to a few cm: 1e-5 of a weight.
      EXPECT_GT(depth_inside(h.patches[h.nodes[part].patch].vertices, s.position), -1e-5);
      std::uint32_t top = part;
      while (h.nodes[top].parent != kNone && top != leaf) top = h.nodes[top].parent;
      EXPECT_EQ(top, leaf);
      found.insert(part);
    }
    // The smallest have 1/64 of the area: to miss one in 2000 draws has a chance of 2e-14, times 4 parts and the leaves.
    EXPECT_EQ(found.size(), 10U);
  }
}

TEST(Hierarchy, SamplesLeavesInProportionToAreaAndToPower) {
  const World world(test::own_scene("cornell"));
  const Hierarchy h = all_sides(world);
  for (const SampleBy by : {SampleBy::kArea, SampleBy::kEmittedPower}) {
    const auto& before = by == SampleBy::kArea ? h.area_before : h.emission_before;
    std::vector<double> observed(h.patches.size()), expected(h.patches.size());
    constexpr int kSamples = 100000;
    RandomSequence random(5);
    for (int i = 0; i < kSamples; ++i) {
      const NodeSample s = sample_node(h, h.nodes[0], by, random.uniform_double(), {random.uniform(), random.uniform()});
      observed[s.patch] += 1;
    }
    for (std::size_t leaf = 0; leaf < h.leaves.size(); ++leaf) {
      expected[h.nodes[h.leaves[leaf]].patch] = kSamples * (before[leaf + 1] - before[leaf]) / before.back();
    }
    EXPECT_GT(test::chi_square(observed, expected).p_value, test::sidak_level(1e-6, 2));
  }
}

}  // namespace
}  // namespace radfarm
