#include "scene/gltf_instancing.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using test::GltfBuilder;
using test::load;
using test::placed;
using test::refusal;
using testing::HasSubstr;

/// The triangle placed three times by node 0, which itself stands at x = 10.
GltfBuilder three_triangles() {
  GltfBuilder gltf = test::triangle();
  const auto places = gltf.add_vec3({0, 0, 0, 2, 0, 0, 0, 0, 5});
  const auto scales = gltf.add_vec3({1, 1, 1, 3, 3, 3, 1, 1, 1});
  const auto turns = gltf.add<std::int8_t>({0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 127, 0}, 5120, "VEC4", 3);
  gltf.document["accessors"].back()["normalized"] = true;
  gltf.document["nodes"][0]["translation"] = {10, 0, 0};
  gltf.document["nodes"][0]["name"] = "crowd";
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", places}, {"SCALE", scales}, {"ROTATION", turns}};
  gltf.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return gltf;
}

TEST(GltfInstancing, EveryElementIsAnInstanceRelativeToItsNode) {
  const Result<Scene> scene = load(three_triangles().document);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->instances.size(), 3U);
  EXPECT_EQ(scene->meshes.size(), 1U);
  EXPECT_EQ(scene->instances[2].name, "crowd");
  EXPECT_LT(length(placed(*scene, 0, 1) - Vec3d(11, 0, 0)), 1e-5);
  EXPECT_LT(length(placed(*scene, 1, 1) - Vec3d(15, 0, 0)), 1e-5);
  EXPECT_LT(length(placed(*scene, 2, 1) - Vec3d(9, 0, 5)), 1e-5);  // half a turn about z
}

TEST(GltfInstancing, AttributesMayBeMissing) {
  GltfBuilder gltf = three_triangles();
  auto& attributes = gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  for (const char* key : {"SCALE", "ROTATION"}) attributes.erase(key);
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(length(placed(*scene, 1, 1) - Vec3d(13, 0, 0)), 1e-5);
}

TEST(GltfInstancing, FaultsAreNamed) {
  const std::string place = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/";
  GltfBuilder gltf = three_triangles();
  auto& attributes = gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["SCALE"] = 99;
  EXPECT_THAT(refusal(gltf.document), HasSubstr(place + "SCALE: accessor 99 does not exist"));
  attributes["SCALE"] = attributes["ROTATION"];
  EXPECT_EQ(refusal(gltf.document), place + "SCALE: must be a VEC3");
  attributes["SCALE"] = gltf.add_vec3({1, 1, 1});
  EXPECT_EQ(refusal(gltf.document), place + "SCALE: has another count than other attributes");
}

TEST(GltfInstancing, TooManyInstancesAreRefusedBeforeTheyAreMade) {
  GltfBuilder gltf = three_triangles();
  gltf.document["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 20000000}});
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf.document["accessors"].size() - 1}};
  EXPECT_EQ(refusal(gltf.document), "/nodes/0: scene has more than 10000000 instances");
}

}  // namespace
}  // namespace radfarm
