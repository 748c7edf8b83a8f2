#include "senders/vertex_senders.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

bool same(const VertexSenders& a, const VertexSenders& b) {
  const auto lobe = [](const Lobe& x, const Lobe& y) { return test::operator==(x, y); };
  const auto critical = [](const CriticalSender& x, const CriticalSender& y) {
    return x.node == y.node && x.resample_form_factor == y.resample_form_factor &&
           x.resample_visibility == y.resample_visibility && x.direction == y.direction && x.direct == y.direct &&
           x.indirect == y.indirect && x.visibility == y.visibility && x.weight == y.weight;
  };
  return std::equal(a.lobes.begin(), a.lobes.end(), b.lobes.begin(), b.lobes.end(), lobe) &&
         std::equal(a.critical.begin(), a.critical.end(), b.critical.begin(), b.critical.end(), critical);
}

TEST(VertexSenders, AreAFunctionOfTheirArguments) {
  const SolvedScene scene("cornell");
  const SenderGridFile file = scene.classify();
  const VertexContext context{scene.world, scene.tree, file.grid, file.receivers, scene.settings, 1};
  for (std::size_t i = 0; i < file.vertices.size(); i += 5) {
    EXPECT_TRUE(same(vertex_senders(context, file.vertices[i]), file.senders[i])) << file.vertices[i];
  }
}

TEST(VertexSenders, WeightsOfCriticalSendersAddUpToOne) {
  for (const char* name : {"cornell", "sheet", "emitters_reflect"}) {
    const SolvedScene scene(name);
    std::size_t critical = 0, lobes = 0;
    for (const VertexSenders& senders : scene.classify().senders) {
      double sum = 0;
      std::set<std::uint32_t> nodes;
      for (const CriticalSender& sender : senders.critical) {
        EXPECT_LT(sender.node, scene.tree.nodes.size());
        EXPECT_GT(sender.weight, 0);
        EXPECT_TRUE(sender.visibility >= 0 && sender.visibility <= 1.0001F);
        EXPECT_TRUE(sender.resample_form_factor + sender.resample_visibility >= 1);
        nodes.insert(sender.node);
        sum += static_cast<double>(sender.weight);
      }
      EXPECT_EQ(nodes.size(), senders.critical.size());
      EXPECT_TRUE(senders.critical.empty() || std::abs(sum - 1) < 1e-4) << sum;
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
