#include "estimate/gather.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "effects/specialise.h"
#include "scene/light_scene.h"
#include "statistical/rendered_view.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr int kWidth = 48;
constexpr int kHeight = 36;
// Radiosity (links, residual, gloss folded into diffuse) and interpolation (threshold) are biased; their budgets add up
// to this share of the light.
constexpr double kBias = 0.03;
// Standard errors of noise on top: one false alarm in 16000 for one scene without any bias, and seeds are fixed.
constexpr double kErrors = 4;

struct SceneAndSky {
  const char* name;
  const char* env = "";
};

void PrintTo(const SceneAndSky& of, std::ostream* out) { *out << of.name; }

/// A scene through both integrators.
struct Compared {
  explicit Compared(const SceneAndSky& of) {
    Scene scene = test::own_scene(of.name);
    EXPECT_TRUE(light_scene({of.env, {}}, "", scene));
    const World world(specialise(std::move(scene), kFoldable));  // the light that photon tasks bring is not here
    const Film film{world.scene.cameras.at(0), kWidth, kHeight, 1};
    gathered = test::gathered(world, film, 16);
    traced = test::path_traced(world, film, 128);
  }
  test::Mean gathered, traced;
};

class GatherOf : public testing::TestWithParam<SceneAndSky> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GatherOf,
                         testing::Values(SceneAndSky{"furnace"}, SceneAndSky{"cornell"}, SceneAndSky{"room"},
                                         SceneAndSky{"point_light"}, SceneAndSky{"effects/glossy_floor"},
                                         SceneAndSky{"effects/window", "sky:overcast,lux=50"},
                                         SceneAndSky{"effects/open_plane_sky", "sky:overcast,lux=3"},
                                         SceneAndSky{"effects/mirror"}, SceneAndSky{"effects/clearcoat"},
                                         SceneAndSky{"effects/vertex_colours"}, SceneAndSky{"effects/alpha_mask"},
                                         SceneAndSky{"effects/normal_map"}),
                         [](const auto& p) {
                           const std::string name = p.param.name;
                           return name.substr(name.find('/') + 1);
                         });

TEST_P(GatherOf, HasTheMeanLightOfAPathTrace) {
  const Compared both(GetParam());
  EXPECT_EQ(both.gathered.dropped + both.traced.dropped, 0U);
  ASSERT_GT(both.traced.value, 0);
  const double noise = std::hypot(both.gathered.error, both.traced.error) / both.traced.value;
  const double ratio = both.gathered.value / both.traced.value;
  RecordProperty("ratio", std::to_string(ratio));
  RecordProperty("noise", std::to_string(noise));
  EXPECT_NEAR(ratio, 1, kBias + kErrors * noise);
}

TEST(Gather, TheDarkChamberOfTheSheetIsBlack) {
  const Compared both({"sheet"});
  EXPECT_EQ(both.gathered.largest, 0);
  EXPECT_EQ(both.traced.largest, 0);
}

}  // namespace
}  // namespace radfarm
