#include "scene/summary.h"

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

TEST(Summary, CountsInstancedTrianglesAndAddsTheirArea) {
  nlohmann::json document = test::triangle().document;
  document["nodes"] = nlohmann::json::parse(R"([{"children": [1, 2]}, {"mesh": 0},
                                                {"mesh": 0, "scale": [2, 2, 2], "translation": [5, 0, 0]}])");
  document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  const Result<Scene> scene = test::load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  const nlohmann::json summary = summarize(*scene);
  EXPECT_EQ(summary["triangles"], 2);
  EXPECT_EQ(summary["stored_triangles"], 1);
  EXPECT_EQ(summary["emissive_materials"], 1);
  EXPECT_NEAR(summary["surface_area_m2"], 0.5 + 2, 1e-6);
  EXPECT_NEAR(summary["bounds"]["max"][0], 7, 1e-6);
  EXPECT_EQ(summary["lights"]["point"], 0);
}

TEST(Summary, AnEmptySceneHasNoBounds) { EXPECT_TRUE(summarize(Scene{})["bounds"].is_null()); }

}  // namespace
}  // namespace radfarm
