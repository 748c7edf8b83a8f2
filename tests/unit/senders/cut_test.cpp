#include "senders/cut.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/random.h"
#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

/// Walks down from `node`: every branch must end in exactly one node of the cut, or in one that is turned away.
void expect_covered(const SenderTree& tree, const ReceiverRegion& region, const std::set<std::uint32_t>& cut,
                    std::uint32_t node, bool is_below_cut) {
  const bool is_in_cut = cut.contains(node);
  EXPECT_FALSE(is_in_cut && is_below_cut) << node << " is covered twice";
  if (!is_in_cut && !is_below_cut && is_turned_away(tree.nodes[node], region)) return;
  const bool is_covered = is_in_cut || is_below_cut;
  EXPECT_TRUE(is_covered || tree.nodes[node].child_count > 0) << "leaf " << node;
  for (std::uint32_t i = 0; i < tree.nodes[node].child_count; ++i) {
    expect_covered(tree, region, cut, tree.nodes[node].first_child + i, is_covered);
  }
}

TEST(CutSenders, CoversEveryLeafOnceExceptWhatIsTurnedAway) {
  for (const char* name : {"cornell", "room"}) {
    const SolvedScene scene(name);
    RandomSequence random(1);
    for (int n = 0; n < 60; ++n) {
      const Vec3 size = scene.world.bounds.size();
      const Vec3 place = scene.world.bounds.min + Vec3(random.uniform() * size.x, random.uniform() * size.y,
                                                       random.uniform() * size.z);
      const ReceiverRegion region{place, 0.2F * random.uniform()};
      const float change = n % 3 == 0 ? 0 : 0.5F * random.uniform();
      const std::vector<std::uint32_t> cut = cut_senders(scene.tree, region, change, n % 2 == 0 ? 50 : 100000);
      EXPECT_TRUE(std::is_sorted(cut.begin(), cut.end()));
      const std::set<std::uint32_t> nodes(cut.begin(), cut.end());
      EXPECT_EQ(nodes.size(), cut.size());
      expect_covered(scene.tree, region, nodes, 0, false);
    }
  }
}

TEST(CutSenders, StaysWithinItsLimitAndGrowsAsTheThresholdFalls) {
  const SolvedScene scene("room");
  const ReceiverRegion region{scene.world.bounds.center(), 0.1F};
  std::size_t before = 0;
  for (const float change : {1e9F, 1.0F, 0.1F, 0.01F, 0.0F}) {
    const std::size_t now = cut_senders(scene.tree, region, change, 1000000).size();
    EXPECT_GE(now, before);
    before = now;
  }
  // A split replaces one node by up to four (parts of a patch).
  for (const std::uint32_t most : {1U, 10U, 200U}) EXPECT_LE(cut_senders(scene.tree, region, 0, most).size(), most + 3);
  EXPECT_TRUE(cut_senders(SenderTree(), region, 0, 10).empty());
}

TEST(CutSenders, TurnedAwayMeansThatNoPatchFacesThePoint) {
  const SolvedScene scene("cornell");
  RandomSequence random(2);
  std::size_t turned_away = 0;
  for (int n = 0; n < 300; ++n) {
    const Vec3 size = scene.world.bounds.size();
    const Vec3 place = scene.world.bounds.min +
                       Vec3(random.uniform() * size.x, random.uniform() * size.y, random.uniform() * size.z);
    const ReceiverRegion region{place, 0.1F};
    for (std::uint32_t id = 0; id < scene.tree.nodes.size(); ++id) {
      const SenderNode& node = scene.tree.nodes[id];
      if (node.patch == kNone || !is_turned_away(node, region)) continue;
      ++turned_away;
      const SenderPatch& patch = scene.tree.patches[node.patch];
      // The farthest point of the region along the patch's normal still lies behind its plane, to float rounding.
      EXPECT_LE(dot(patch.normal, place - patch.vertices[0]) + region.radius, 1e-3F);
    }
  }
  EXPECT_GT(turned_away, 0U);
}

}  // namespace
}  // namespace radfarm
