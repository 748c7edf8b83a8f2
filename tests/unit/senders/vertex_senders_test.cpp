#include "senders/vertex_senders.h"

#include <set>

#include <gtest/gtest.h>

#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

TEST(VertexSenders, AreAFunctionOfTheirArguments) {
  const SolvedScene scene("cornell");
  const SenderGridFile file = scene.classify();
  const VertexContext context{scene.world, scene.tree, file.grid, file.receivers, file.thresholds, scene.settings, 1};
  SenderGridFile again{file.grid, file.receivers, file.vertices, {}, file.thresholds};
  for (const std::uint32_t vertex : file.vertices) again.senders.push_back(vertex_senders(context, vertex));
  EXPECT_EQ(encode(again), encode(file));
}

TEST(VertexSenders, AreDistinctNodesAndLightThatIsNowhereNegative) {
  for (const char* name : {"cornell", "sheet", "emitters_reflect"}) {
    const SolvedScene scene(name);
    std::size_t critical = 0, lobes = 0;
    for (const VertexSenders& senders : scene.classify().senders) {
      std::set<std::uint32_t> nodes;
      std::uint32_t both = 0;
      for (const CriticalSender& sender : senders.critical) {
        EXPECT_LT(sender.node, scene.tree.nodes.size());
        EXPECT_GE(min_component(sender.direct), 0);
        EXPECT_GE(min_component(sender.indirect), 0);
        EXPECT_TRUE(min_component(sender.visibility) >= 0 && max_component(sender.visibility) <= 1.0001F);
        EXPECT_TRUE(sender.resample_form_factor + sender.resample_visibility >= 1);
        both += sender.resample_form_factor * sender.resample_visibility;
        nodes.insert(sender.node);
      }
      EXPECT_EQ(nodes.size(), senders.critical.size());
      EXPECT_EQ(senders.classes.both, both);
      EXPECT_EQ(senders.classes.total() - senders.classes.interpolated, senders.critical.size());
      EXPECT_GE(senders.classes.interpolated, senders.lobes.size());
      for (const Lobe& lobe : senders.lobes) {
        EXPECT_NEAR(length(lobe.direction), 1, 1e-4);
        EXPECT_GE(min_component(lobe.direct), 0);
        EXPECT_GE(min_component(lobe.indirect), 0);
      }
      critical += senders.critical.size();
      lobes += senders.lobes.size();
    }
    EXPECT_GT(critical + lobes, 0U) << name;
  }
}

TEST(VertexSenders, AThresholdOfZeroResamplesWhateverVaries) {
  SolvedScene scene("emitters_reflect");
  const auto critical_count = [&](float threshold) {
    scene.settings.threshold = threshold;
    std::size_t count = 0;
    for (const VertexSenders& senders : scene.classify().senders) count += senders.critical.size();
    return count;
  };
  EXPECT_GT(critical_count(0), 0U);
  EXPECT_EQ(critical_count(1e9F), 0U);
}

}  // namespace
}  // namespace radfarm
