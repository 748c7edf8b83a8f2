#include "scene/gltf_check.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using test::refusal;
using test::triangle;
using testing::HasSubstr;
using testing::StartsWith;

TEST(GltfCheck, AWellFormedTriangleLoads) { EXPECT_EQ(refusal(triangle().document), "loads"); }

TEST(GltfCheck, NamesTheIndexThatDoesNotExistAndHowManyThereAre) {
  json document = triangle().document;
  document["meshes"][0]["primitives"][0]["indices"] = 12;
  EXPECT_EQ(refusal(document), "/meshes/0/primitives/0/indices: accessor 12 does not exist (there are 2)");
}

struct Fault {
  const char* change;   // a JSON merge patch to the triangle
  const char* pointer;  // where the message must point
};

class GltfFault : public testing::TestWithParam<Fault> {};

TEST_P(GltfFault, IsRefusedWithItsPointer) {
  json document = triangle().document;
  document.merge_patch(json::parse(GetParam().change));
  EXPECT_THAT(refusal(document), StartsWith(std::string(GetParam().pointer) + ": "));
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfFault,
    testing::Values(
        Fault{R"({"asset": null})", "/"}, Fault{R"({"asset": {"version": "1.0"}})", "/asset/version"},
        Fault{R"({"asset": {"minVersion": "2.1"}})", "/asset/minVersion"},
        Fault{R"({"extensionsRequired": ["KHR_texture_transform", "KHR_texture_basisu"]})",
              "/extensionsRequired/1"},
        Fault{R"({"scene": 3})", "/scene"}, Fault{R"({"scenes": [{"nodes": [7]}]})", "/scenes/0/nodes/0"},
        Fault{R"({"nodes": [{"mesh": -1}]})", "/nodes/0/mesh"}, Fault{R"({"nodes": [{"mesh": 1}]})", "/nodes/0/mesh"},
        Fault{R"({"nodes": [5]})", "/nodes/0"}, Fault{R"({"nodes": {}})", "/nodes"},
        Fault{R"({"nodes": [{"children": [0]}]})", "/nodes/0"},
        Fault{R"({"nodes": [{"children": [1]}, {"children": [0]}]})", "/nodes/0"},
        Fault{R"({"nodes": [{"children": [1]}, {}, {"children": [1]}]})", "/nodes/2/children/0"},
        Fault{R"({"nodes": [{"children": [1]}, {}], "scenes": [{"nodes": [0, 1]}]})", "/scenes/0/nodes/1"},
        Fault{R"({"nodes": [{"scale": [1, 1]}]})", "/nodes/0/scale"},
        Fault{R"({"nodes": [{"translation": [1, 1, "x"]}]})", "/nodes/0/translation/2"},
        Fault{R"({"nodes": [{"translation": [1, 1, 1e30]}]})", "/nodes/0/translation/2"},
        Fault{R"({"nodes": [{"matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})", "/nodes/0/matrix"},
        Fault{R"({"nodes": [{"camera": 0}]})", "/nodes/0/camera"},
        Fault{R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})",
              "/nodes/0/extensions/KHR_lights_punctual/light"},
        Fault{R"({"buffers": [{"byteLength": 0}, {"byteLength": 6}]})", "/buffers/0/byteLength"},
        Fault{R"({"buffers": [{"byteLength": 36}, {"byteLength": 6}]})", "/buffers/0"},
        Fault{R"({"buffers": [{"byteLength": 36, "uri": "../secret.bin"}, {"byteLength": 6}]})", "/buffers/0/uri"},
        Fault{R"({"buffers": [{"byteLength": 36, "uri": "missing.bin"}, {"byteLength": 6}]})", "/buffers/0/uri"},
        Fault{R"({"buffers": [{"byteLength": 36, "uri": "data:;base64,AAAA"}, {"byteLength": 6}]})",
              "/buffers/0/byteLength"},
        Fault{R"({"bufferViews": [{"buffer": 0, "byteLength": 99}, {"buffer": 1, "byteLength": 6}]})",
              "/bufferViews/0"},
        Fault{R"({"bufferViews": [{"buffer": 9, "byteLength": 9}]})", "/bufferViews/0/buffer"},
        Fault{R"({"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4}]})",
              "/accessors/0"},
        Fault{R"({"accessors": [{"bufferView": 0, "componentType": 5, "type": "VEC3", "count": 3}]})",
              "/accessors/0/componentType"},
        Fault{R"({"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC9", "count": 3}]})",
              "/accessors/0/type"},
        Fault{R"({"accessors": [{"bufferView": 7, "componentType": 5126, "type": "VEC3", "count": 3}]})",
              "/accessors/0/bufferView"},
        Fault{R"({"meshes": [{}]})", "/meshes/0"},
        Fault{R"({"meshes": [{"primitives": [{"attributes": {"POSITION": -1}}]}]})",
              "/meshes/0/primitives/0/attributes/POSITION"},
        Fault{R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 7}]}]})",
              "/meshes/0/primitives/0/mode"},
        Fault{R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0}]}]})",
              "/meshes/0/primitives/0/indices"},
        Fault{R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 2}]}]})",
              "/meshes/0/primitives/0/material"},
        Fault{R"({"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1.5, 0, 0, 1]}}]})",
              "/materials/0/pbrMetallicRoughness/baseColorFactor/0"},
        Fault{R"({"materials": [{"emissiveFactor": [0, -1, 0]}]})", "/materials/0/emissiveFactor/1"},
        Fault{R"({"materials": [{"emissiveTexture": {"index": 0}}]})", "/materials/0/emissiveTexture/index"},
        Fault{R"({"materials": [{"pbrMetallicRoughness": {"roughnessFactor": 2}}]})",
              "/materials/0/pbrMetallicRoughness/roughnessFactor"},
        Fault{R"({"materials": [{"normalTexture": {"index": 0}}]})", "/materials/0/normalTexture/index"},
        Fault{R"({"materials": [{"extensions": {"KHR_materials_transmission": {"transmissionFactor": -1}}}]})",
              "/materials/0/extensions/KHR_materials_transmission/transmissionFactor"},
        Fault{R"({"materials": [{"extensions": {"KHR_materials_sheen": {"sheenColorTexture": {}}}}]})",
              "/materials/0/extensions/KHR_materials_sheen/sheenColorTexture"},
        Fault{R"({"cameras": [{"type": "perspective", "perspective": {"yfov": 0, "znear": 1}}]})",
              "/cameras/0/perspective/yfov"},
        Fault{R"({"cameras": [{"type": "orthographic",
                               "orthographic": {"xmag": 1, "ymag": 0, "znear": 0, "zfar": 1}}]})",
              "/cameras/0/orthographic/ymag"},
        Fault{R"({"extensions": {"KHR_lights_punctual": {"lights": [{"type": "disc"}]}}})",
              "/extensions/KHR_lights_punctual/lights/0/type"},
        Fault{R"({"extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": -3}]}}})",
              "/extensions/KHR_lights_punctual/lights/0/intensity"},
        Fault{R"({"extensions": {"KHR_lights_punctual": {"lights": [
                  {"type": "spot", "spot": {"innerConeAngle": 0.9, "outerConeAngle": 0.5}}]}}})",
              "/extensions/KHR_lights_punctual/lights/0/spot"},
        Fault{R"({"skins": [{"joints": [9]}]})", "/skins/0/joints/0"},
        Fault{R"({"animations": [{"samplers": [{"input": 0, "output": 9}], "channels": []}]})",
              "/animations/0/samplers/0/output"}));

TEST(GltfCheck, ARequiredExtensionIsNamed) {
  json document = triangle().document;
  document["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_THAT(refusal(document), HasSubstr("required extension KHR_texture_basisu is not supported"));
}

TEST(GltfCheck, NodesDeeperThanTheLimitAreRefused) {
  json document = triangle().document;
  document["nodes"] = json::array();
  for (int i = 0; i < 1500; ++i) document["nodes"].push_back({{"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  EXPECT_THAT(refusal(document), HasSubstr("node lies deeper than 1000"));
}

TEST(GltfCheck, AFileWithoutScenesNodesOrMeshesLoadsEmpty) {
  const Result<Scene> scene = test::load({{"asset", {{"version", "2.0"}}}});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->instances.empty());
}

TEST(GltfCheck, SparseAccessorsMustLieInsideTheirViews) {
  json document = triangle().document;
  document["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", 1}, {"byteOffset", 5}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}};
  EXPECT_THAT(refusal(document), StartsWith("/accessors/0/sparse/indices: "));
  document["accessors"][0]["sparse"]["count"] = 4;
  EXPECT_THAT(refusal(document), StartsWith("/accessors/0/sparse/count: "));
}

}  // namespace
}  // namespace radfarm
