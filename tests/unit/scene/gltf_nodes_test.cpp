#include "scene/gltf_nodes.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using test::load;
using test::placed;
using test::triangle;
using testing::Contains;
using testing::HasSubstr;

Scene scene_with_nodes(const char* nodes, const char* more = "{}") {
  json document = triangle().document;
  document["nodes"] = json::parse(nodes);
  document.merge_patch(json::parse(more));
  Result<Scene> scene = load(document);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : Scene{};
}

void expect_at(const Vec3d& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-5);
  EXPECT_NEAR(p.y, y, 1e-5);
  EXPECT_NEAR(p.z, z, 1e-5);
}

TEST(GltfNodes, ScaleComesBeforeRotationBeforeTranslation) {
  const Scene scene = scene_with_nodes(
      R"([{"mesh": 0, "translation": [10, 0, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476],
           "scale": [2, 3, 1]}])");
  expect_at(placed(scene, 0, 1), 10, 2, 0);  // x of length 2 turns to y
  expect_at(placed(scene, 0, 2), 7, 0, 0);   // y of length 3 turns to -x
}

TEST(GltfNodes, MatricesAreColumnMajorAndParentsApplyLast) {
  const Scene scene = scene_with_nodes(
      R"([{"children": [1], "scale": [2, 2, 2]},
          {"mesh": 0, "matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1]}])");
  expect_at(placed(scene, 0, 0), 10, 12, 14);
  expect_at(placed(scene, 0, 1), 10, 14, 14);
}

TEST(GltfNodes, OneMeshMayStandInManyPlaces) {
  const Scene scene = scene_with_nodes(R"([{"children": [1, 2]}, {"mesh": 0, "name": "left"},
                                           {"mesh": 0, "translation": [3, 0, 0]}])");
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "left");
  expect_at(placed(scene, 1, 0), 3, 0, 0);
}

TEST(GltfNodes, InstancesOfZeroScaleAreDroppedWithANote) {
  const Scene scene = scene_with_nodes(R"([{"mesh": 0, "scale": [1, 0, 1]}])");
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_THAT(scene.notes, Contains(HasSubstr("zero scale")));
}

TEST(GltfNodes, WithoutScenesAllRootNodesAreTaken) {
  json document = triangle().document;
  document.erase("scenes");
  document.erase("scene");
  document["nodes"] = json::parse(R"([{"children": [1]}, {"mesh": 0}, {"mesh": 0}])");
  EXPECT_EQ(load(document)->instances.size(), 2U);
}

TEST(GltfNodes, PerspectiveCamerasTakeTheirNodesPlaceWithoutItsScale) {
  const Scene scene = scene_with_nodes(
      R"([{"camera": 0, "name": "view", "translation": [1, 2, 3], "scale": [4, 4, 4],
           "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}])",
      R"({"cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5}}]})");
  ASSERT_EQ(scene.cameras.size(), 1U);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "view");
  expect_at(to_double(camera.position) + scene.origin, 1, 2, 3);
  expect_at(to_double(camera.forward), -1, 0, 0);
  expect_at(to_double(camera.right), 0, 0, -1);
  EXPECT_FLOAT_EQ(camera.vertical_fov, 0.8F);
  EXPECT_FLOAT_EQ(camera.aspect, 1.5F);
}

TEST(GltfNodes, OrthographicCamerasGrowWithTheirNode) {
  const Scene scene = scene_with_nodes(
      R"([{"camera": 0, "scale": [2, 3, 1]}])",
      R"({"cameras": [{"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 2, "znear": 0, "zfar": 9}}]})");
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_FLOAT_EQ(scene.cameras[0].half_height, 6);
  EXPECT_FLOAT_EQ(scene.cameras[0].aspect, 8.0F / 6);
}

TEST(GltfNodes, PunctualLightsShineAlongTheirNodesMinusZ) {
  const Scene scene = scene_with_nodes(
      R"([{"translation": [0, 5, 0], "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
           "extensions": {"KHR_lights_punctual": {"light": 0}}}])",
      R"({"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 10, "color": [1, 0.5, 0],
          "range": 3, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]}}})");
  ASSERT_EQ(scene.lights.size(), 1U);
  const PunctualLight& light = scene.lights[0];
  EXPECT_EQ(light.kind, PunctualLight::Kind::kSpot);
  expect_at(to_double(light.direction), 0, -1, 0);
  expect_at(to_double(light.position) + scene.origin, 0, 5, 0);
  EXPECT_EQ(light.intensity, Spectrum(10, 5, 0));
  EXPECT_FLOAT_EQ(light.cos_outer, std::cos(0.2F));
  EXPECT_THAT(scene.notes, Contains(HasSubstr("range")));
}

TEST(GltfNodes, PunctualLightsAreNamedAndKnowTheirNodesRight) {
  const Scene scene = scene_with_nodes(
      R"([{"name": "hall", "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 4],
           "extensions": {"KHR_lights_punctual": {"light": 0}}},
          {"name": "stairs", "scale": [0, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 1}}}])",
      R"({"scenes": [{"nodes": [0, 1]}], "extensions": {"KHR_lights_punctual": {"lights": [
          {"type": "point", "name": "lamp"}, {"type": "point"}]}}})");
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  expect_at(to_double(scene.lights[0].right), 0, 1, 0);
  EXPECT_EQ(scene.lights[1].name, "stairs");
  EXPECT_NEAR(dot(scene.lights[1].right, scene.lights[1].direction), 0, 1e-6);
  EXPECT_NEAR(length(scene.lights[1].right), 1, 1e-6);
}

TEST(GltfPose, NodesStandWhereTheFirstKeyPutsThem) {
  test::GltfBuilder gltf = triangle();
  const auto times = gltf.add<float>({0, 1}, 5126, "SCALAR", 2);
  const auto places = gltf.add_vec3({7, 0, 0, 9, 0, 0});
  gltf.document["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  expect_at(placed(*scene, 0, 0), 7, 0, 0);
  EXPECT_THAT(scene->notes, Contains(HasSubstr("t = 0")));
}

}  // namespace
}  // namespace radfarm
