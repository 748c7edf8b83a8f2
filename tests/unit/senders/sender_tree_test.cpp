#include "senders/sender_tree.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

float power_of(const SenderNode& node) { return luminance(node.emitted_power) + luminance(node.reflected_power); }

TEST(SenderTree, HasTheSolutionsPowerAtItsRootAndInItsLeaves) {
  for (const char* name : {"cornell", "emitters_reflect", "point_light", "sheet"}) {
    const SolvedScene scene(name);
    const RadiositySolution& solution = scene.solution;
    const double truth = luminance(SpectrumD(solution.hierarchy.nodes[0].emitted_power)) +
                         luminance(SpectrumD(solution.reflected_power[0]));
    double leaves = 0;
    for (const SenderNode& node : scene.tree.nodes) {
      if (node.patch != kNone) leaves += static_cast<double>(power_of(node));
    }
    // Sums of thousands of floats.
    EXPECT_NEAR(static_cast<double>(power_of(scene.tree.nodes[0])), truth, 1e-4 * truth) << name;
    EXPECT_NEAR(leaves, truth, 1e-4 * truth) << name;
  }
}

TEST(SenderTree, HasOnlyNodesThatSend) {
  const SolvedScene scene("room");
  for (std::uint32_t i = 0; i < scene.tree.nodes.size(); ++i) {
    const SenderNode& node = scene.tree.nodes[i];
    EXPECT_GT(power_of(node), 0);
    EXPECT_EQ(node.patch == kNone, node.child_count > 0);
    if (node.child_count == 0) continue;
    EXPECT_GT(node.first_child, i);
    double sum = 0;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      sum += static_cast<double>(power_of(scene.tree.nodes[node.first_child + c]));
    }
    EXPECT_NEAR(static_cast<double>(power_of(node)), sum, 1e-4 * sum);
  }
}

double radiosity(const Node& node, const Spectrum& power) {
  return static_cast<double>(luminance(power)) / static_cast<double>(node.area);
}

/// The mean radiosity of undivided patches that are at most 8 times as bright as it, from above.
double usual_radiosity(const RadiositySolution& solution) {
  std::vector<std::pair<double, double>> patches;  // radiosity, area
  for (std::size_t i = 0; i < solution.hierarchy.nodes.size(); ++i) {
    const Node& node = solution.hierarchy.nodes[i];
    if (is_undivided(node)) patches.emplace_back(radiosity(node, solution.reflected_power[i]), node.area);
  }
  std::sort(patches.begin(), patches.end());
  for (std::size_t count = patches.size();;) {
    double power = 0, area = 0;
    for (std::size_t i = 0; i < count; ++i) power += patches[i].first * patches[i].second, area += patches[i].second;
    const std::size_t before = count;
    while (count > 0 && patches[count - 1].first > 8 * power / area) --count;
    if (count == before) return power / area;
  }
}

TEST(SenderTree, EmittersAndWhatTheyMakeFarBrighterThanUsualAreSendersAndAllElseReflectors) {
  for (const char* name : {"cornell", "emitters_reflect", "sheet", "room"}) {
    const SolvedScene scene(name);
    const RadiositySolution& solution = scene.solution;
    const SenderTree tree = make_sender_tree(solution);
    double by_lines = 0, by_rays = 0, reflected = 0, bright = 0;
    const double usual = usual_radiosity(solution);
    for (const SenderNode& node : tree.nodes) {
      if (node.patch != kNone) by_lines += static_cast<double>(luminance(node.reflected_power));
    }
    for (const Reflector& reflector : tree.reflectors) {
      const double power = static_cast<double>(luminance(reflector.radiance) * kPi * area_of(reflector.vertices));
      if (reflector.by_lines == 0) by_rays += power;
    }
    for (std::size_t i = 0; i < solution.hierarchy.nodes.size(); ++i) {
      const Node& node = solution.hierarchy.nodes[i];
      if (node.is_cluster() || node.child_count > 0) continue;
      reflected += static_cast<double>(luminance(solution.reflected_power[i]));
      const bool is_bright = radiosity(node, solution.reflected_direct[i]) > 8 * usual;
      if (is_bright) bright += static_cast<double>(luminance(solution.reflected_power[i]));
    }
    // Sums of thousands of floats.
    EXPECT_NEAR(by_lines + by_rays, reflected, 1e-4 * reflected) << name;
    EXPECT_NEAR(by_lines, bright, 1e-4 * reflected) << name;
    EXPECT_NEAR(static_cast<double>(luminance(tree.nodes[0].emitted_power)),
                static_cast<double>(luminance(solution.hierarchy.nodes[0].emitted_power)), 1e-4 * reflected) << name;
  }
}

// A patch of which a part hangs over a gap that catches light.
TEST(SenderTree, WhatSurfacesMakeFarBrighterThanUsualIsDoubtedAndSendsByRays) {
  const SolvedScene scene("room");
  RadiositySolution solution = scene.solution;
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  const double usual = usual_radiosity(solution);
  std::size_t dim = 0;
  while (!is_undivided(nodes[dim]) || !(radiosity(nodes[dim], solution.reflected_power[dim]) > usual / 4) ||
         radiosity(nodes[dim], solution.reflected_direct[dim]) > usual) {
    ++dim;
  }
  const std::size_t before = make_sender_tree(solution).nodes.size();
  solution.reflected_power[dim] *= 1e5F;
  const SenderTree tree = make_sender_tree(solution);
  EXPECT_EQ(tree.nodes.size(), before) << "the others are as bright as they were, by what is usual";
  const Patch& patch = solution.hierarchy.patches[nodes[dim].patch];
  std::size_t found = 0;
  for (const Reflector& reflector : tree.reflectors) {
    if (reflector.vertices != patch.vertices || reflector.is_front != patch.is_front) continue;
    ++found;
    EXPECT_EQ(reflector.is_doubtful, 1U);
    EXPECT_EQ(reflector.by_lines, 0U);
  }
  EXPECT_EQ(found, 1U);
}

TEST(SenderTree, WhereAllAreSendersRaysBringWhatIsNearButEmitters) {
  const SolvedScene scene("emitters_reflect");
  std::size_t emitters = 0;
  for (const Reflector& reflector : scene.tree.reflectors) {
    ASSERT_NE(reflector.sender, kNone);
    const SenderNode& node = scene.tree.nodes[reflector.sender];
    ASSERT_NE(node.patch, kNone);
    EXPECT_EQ(reflector.by_lines != 0, scene.tree.patches[node.patch].emits != 0);
    emitters += reflector.by_lines;
  }
  EXPECT_GT(emitters, 0U);
}

TEST(SenderTree, RoundTripKeepsEveryByte) {
  const SolvedScene scene("cornell");
  const std::vector<std::byte> bytes = encode(scene.tree);
  const Result<SenderTree> again = decode_sender_tree(bytes);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->nodes.size(), scene.tree.nodes.size());
  const std::span<const std::byte> nodes = std::as_bytes(again->nodes);
  EXPECT_TRUE(nodes.data() > bytes.data() && nodes.data() + nodes.size() < bytes.data() + bytes.size()) << "used in place";
  EXPECT_EQ(encode(*again), bytes);
}

TEST(SenderTree, HostileBytesGiveDataLossOrASoundTree) {
  const SolvedScene scene("plates");
  const std::vector<std::byte> bytes = encode(scene.tree);
  // Up to 63 bytes behind the last array are padding.
  for (std::size_t size = 0; size + 64 <= bytes.size(); size += 1 + size / 64) {
    const Result<SenderTree> cut = decode_sender_tree(std::span(bytes).first(size));
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, Code::kDataLoss);
  }
  RandomSequence random(1);
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::byte> damaged = bytes;
    damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const Result<SenderTree> tree = decode_sender_tree(damaged);
    if (!tree) continue;
    for (std::uint32_t i = 0; i < tree->nodes.size(); ++i) {
      const SenderNode& node = tree->nodes[i];
      EXPECT_TRUE(node.child_count == 0 ||
                  (node.first_child > i && node.first_child + node.child_count <= tree->nodes.size()));
    }
    if (!tree->nodes.empty()) (void)sample_sender(*tree, 0, 0.5F, {0.5F, 0.5F});
  }
}

TEST(SenderTree, ACopyKeepsTheArraysAlive) {
  SenderTree copy;
  {
    const SenderTree tree = own_sender_tree({SenderNode()}, {SenderPatch()});
    copy = tree;
  }
  EXPECT_EQ(copy.arrays.use_count(), 1);
  EXPECT_EQ(copy.nodes[0].patch, kNone);
}

TEST(SenderTree, SamplesLieOnTheirPatch) {
  const SolvedScene scene("cornell");
  RandomSequence random(2);
  for (int n = 0; n < 5000; ++n) {
    const SenderSample s = sample_sender(scene.tree, 0, random.uniform(), {random.uniform(), random.uniform()});
    const SenderPatch& patch = scene.tree.patches[s.patch];
    const TriangleVertices& v = patch.vertices;
    EXPECT_LT(length(v[0] * (1 - s.u - s.v) + v[1] * s.u + v[2] * s.v - s.position), 1e-5F);
    EXPECT_EQ(s.normal, patch.normal);
    EXPECT_TRUE(s.u >= 0 && s.v >= 0 && s.u + s.v <= 1 + 1e-6F);
  }
}

}  // namespace
}  // namespace radfarm
