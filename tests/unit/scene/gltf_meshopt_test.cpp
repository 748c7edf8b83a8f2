#include "scene/gltf_meshopt.h"

#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::load;
using test::refusal;
using testing::HasSubstr;

/// Replaces the bytes of a view by packed ones; the view's own buffer becomes one without data.
void pack_view(GltfBuilder& gltf, std::size_t view_index, const std::vector<unsigned char>& packed, json extension) {
  json& view = gltf.document["bufferViews"][view_index];
  json& buffer = gltf.document["buffers"][view["buffer"].get<std::size_t>()];
  buffer.erase("uri");
  buffer["extensions"]["EXT_meshopt_compression"] = {{"fallback", true}};
  extension["buffer"] = gltf.document["buffers"].size();
  extension["byteLength"] = packed.size();
  view["extensions"]["EXT_meshopt_compression"] = extension;
  gltf.document["buffers"].push_back(
      {{"byteLength", packed.size()}, {"uri", "data:;base64," + test::base64(test::bytes_of(packed))}});
}

/// The triangle with packed positions and indices.
GltfBuilder packed_triangle() {
  GltfBuilder gltf = test::triangle();
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(3, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), 3, 12));
  pack_view(gltf, 0, packed, {{"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}});
  const std::vector<unsigned> indices = {0, 1, 2};
  packed.resize(meshopt_encodeIndexBufferBound(3, 3));
  packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), 3));
  pack_view(gltf, 1, packed, {{"byteStride", 2}, {"count", 3}, {"mode", "TRIANGLES"}});
  gltf.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  return gltf;
}

TEST(GltfMeshopt, PackedViewsGiveTheSameMesh) {
  const Result<Scene> scene = load(packed_triangle().document);
  ASSERT_TRUE(scene) << scene.error().message;
  const Result<Scene> plain = load(test::triangle().document);
  ASSERT_TRUE(plain);
  EXPECT_EQ(scene->meshes[0].positions, plain->meshes[0].positions);
  EXPECT_EQ(scene->meshes[0].triangles, plain->meshes[0].triangles);
}

TEST(GltfMeshopt, IndexSequencesAreUnpacked) {
  GltfBuilder gltf = packed_triangle();
  const std::vector<unsigned> indices = {0, 1, 2};
  std::vector<unsigned char> packed(meshopt_encodeIndexSequenceBound(3, 3));
  packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), 3));
  pack_view(gltf, 1, packed, {{"byteStride", 2}, {"count", 3}, {"mode", "INDICES"}});
  EXPECT_EQ(refusal(gltf.document), "loads");
}

TEST(GltfMeshopt, FiltersAreUndone) {
  // Normals as octahedral bytes; tangents and quaternions go the same way.
  const std::vector<float> normals = {0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0};
  std::vector<std::int8_t> filtered(12);
  meshopt_encodeFilterOct(filtered.data(), 3, 4, 8, normals.data());
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(3, 4));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), filtered.data(), 3, 4));
  GltfBuilder gltf = test::triangle();
  const auto accessor = gltf.add<std::int8_t>(std::vector<std::int8_t>(12, 0), 5120, "VEC3", 3);
  gltf.document["accessors"].back()["normalized"] = true;
  gltf.document["bufferViews"].back()["byteStride"] = 4;
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = accessor;
  pack_view(gltf, gltf.document["bufferViews"].size() - 1, packed,
            {{"byteStride", 4}, {"count", 3}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(length(scene->meshes[0].normals[0] - Vec3(0, 0, 1)), 0.02F);
  EXPECT_LT(length(scene->meshes[0].normals[1] - Vec3(1, 0, 0)), 0.02F);
}

TEST(GltfMeshopt, DamageIsAnErrorWithItsPlace) {
  GltfBuilder gltf = packed_triangle();
  gltf.document["buffers"][2]["uri"] =
      "data:;base64," + test::base64(std::string(gltf.document["buffers"][2]["byteLength"].get<std::size_t>(), '\x55'));
  EXPECT_EQ(refusal(gltf.document),
            "/bufferViews/0/extensions/EXT_meshopt_compression: is damaged: its bytes do not unpack");
}

TEST(GltfMeshopt, ImpossibleNumbersAreRefusedBeforeUnpacking) {
  const auto refusal_with = [](const char* patch) {
    GltfBuilder gltf = packed_triangle();
    gltf.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"].merge_patch(json::parse(patch));
    return refusal(gltf.document);
  };
  EXPECT_THAT(refusal_with(R"({"count": 4000000000})"), HasSubstr("/count: must be a whole number"));
  EXPECT_THAT(refusal_with(R"({"count": 4})"), HasSubstr("does not unpack to the byteLength"));
  EXPECT_THAT(refusal_with(R"({"byteStride": 9, "count": 4})"), HasSubstr("do not agree"));
  EXPECT_THAT(refusal_with(R"({"mode": "PICTURE"})"), HasSubstr("do not agree"));
  EXPECT_THAT(refusal_with(R"({"filter": "QUATERNION"})"), HasSubstr("/filter: "));
  EXPECT_THAT(refusal_with(R"({"byteLength": 99999})"), HasSubstr("lies outside"));
  EXPECT_THAT(refusal_with(R"({"buffer": 9})"), HasSubstr("buffer 9 does not exist"));
  GltfBuilder bomb = packed_triangle();
  bomb.document["buffers"][0]["byteLength"] = 1200000;
  bomb.document["bufferViews"][0]["byteLength"] = 1200000;
  bomb.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 100000;
  EXPECT_THAT(refusal(bomb.document), HasSubstr("cannot hold that many elements"));
}

TEST(GltfMeshopt, AViewLeftInABufferWithoutDataIsAnError) {
  GltfBuilder gltf = packed_triangle();
  gltf.document["bufferViews"][1].erase("extensions");
  EXPECT_EQ(refusal(gltf.document), "/bufferViews/1: its buffer has no data");
}

}  // namespace
}  // namespace radfarm
