#include "cli/ladder_rungs.h"

#include <gmock/gmock.h>

namespace radfarm::cli {
namespace {

using testing::HasSubstr;

TEST(LadderRungs, AreEveryIntegratorWithEveryQuality) {
  RenderRequest base;
  base.width = 100;
  const std::vector<Rung> rungs = make_rungs(base, "gather,path-trace", "preview,high").value();
  ASSERT_EQ(rungs.size(), 4U);
  EXPECT_EQ(rungs[1].name, "gather-high");
  EXPECT_EQ(rungs[2].curve, "path-trace");
  EXPECT_EQ(rungs[2].request.integrator, RenderRequest::Integrator::kPathTrace);
  EXPECT_EQ(rungs[3].request.quality, RenderRequest::Quality::kHigh);
  EXPECT_EQ(rungs[3].request.width, 100);
  EXPECT_FALSE(rungs[0].request.audit);
}

TEST(LadderRungs, NameWhatDoesNotExist) {
  EXPECT_THAT(make_rungs({}, "gather,sparkle", "preview").error().message, HasSubstr("sparkle"));
  EXPECT_THAT(make_rungs({}, "gather", "preview,").error().message, HasSubstr("rung gather-"));
}

TEST(LadderRungs, ReferencesHaveSeedsOfTheirOwn) {
  const RenderRequest a = reference_half({}, 64, 0), b = reference_half({}, 64, 1);
  EXPECT_NE(a.seed, b.seed);
  EXPECT_NE(a.seed, RenderRequest().seed);
  EXPECT_EQ(b.samples, 64);
}

}  // namespace
}  // namespace radfarm::cli
