#include "scene/gltf_draco.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::load;
using test::refusal;
using testing::HasSubstr;

/// The triangle (0,0,0) (1,0,0) (0,1,0) as Draco packs it.
std::string packed_bytes(int method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return std::string(buffer.data(), buffer.size());
}

/// The triangle whose accessors have no bytes but those of the packed view.
GltfBuilder packed_triangle(const std::string& bytes) {
  GltfBuilder gltf = test::triangle();
  gltf.document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data:;base64," + test::base64(bytes)}}};
  gltf.document["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  for (json& accessor : gltf.document["accessors"]) accessor.erase("bufferView");
  gltf.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return gltf;
}

TEST(GltfDraco, PackedPrimitivesGiveTheSameMesh) {
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Result<Scene> scene = load(packed_triangle(packed_bytes(method)).document);
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->meshes[0].triangles.size(), 1U);
    Vec3d sum(0, 0, 0);
    for (const std::uint32_t vertex : scene->meshes[0].triangles[0]) sum += test::placed(*scene, 0, vertex);
    EXPECT_LT(length(sum - Vec3d(1, 1, 0)), 1e-5);
  }
}

TEST(GltfDraco, TwoPrimitivesMayShareOnePackedView) {
  GltfBuilder gltf = packed_triangle(packed_bytes(draco::MESH_SEQUENTIAL_ENCODING));
  json& primitives = gltf.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes.size(), 2U);
}

TEST(GltfDraco, DamagedDataIsAnErrorWithItsPlace) {
  const std::string place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: ";
  const std::string bytes = packed_bytes(draco::MESH_EDGEBREAKER_ENCODING);
  EXPECT_EQ(refusal(packed_triangle(std::string(40, 'x')).document), place + "is not a mesh in Draco's bitstream 2.2");
  EXPECT_EQ(refusal(packed_triangle("DRACO").document), place + "is not a mesh in Draco's bitstream 2.2");
  EXPECT_EQ(refusal(packed_triangle(bytes.substr(0, 16)).document), place + "is damaged: its bytes do not unpack");
}

TEST(GltfDraco, EverySingleDamagedByteIsSurvived) {
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const std::string bytes = packed_bytes(method);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const int change : {1, 0x80, 0xff}) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ change);
        EXPECT_FALSE(refusal(packed_triangle(damaged).document).empty());
      }
    }
  }
}

TEST(GltfDraco, CountsAreCheckedBeforeTheDecoderSeesThem) {
  // Header, then 2^31 faces and 3 points.
  const std::string bomb = std::string("DRACO\x02\x02\x01\x00\x00\x00", 11) + "\x80\x80\x80\x80\x08\x03\x01";
  EXPECT_THAT(refusal(packed_triangle(bomb).document), HasSubstr("holds too many triangles"));
  GltfBuilder gltf = packed_triangle(packed_bytes(draco::MESH_SEQUENTIAL_ENCODING));
  gltf.document["accessors"][0]["count"] = 2;
  EXPECT_THAT(refusal(gltf.document), HasSubstr("holds 3 vertices"));
  gltf.document["accessors"][0]["count"] = 100000000;
  EXPECT_THAT(refusal(gltf.document), HasSubstr("unpacks to more than 1000 times its bytes"));
}

TEST(GltfDraco, AttributesThatWouldTakeTooMuchAreNotUnpacked) {
  // 34 faces, 100 points, 40 attributes of 120 doubles: 3.8 MB in 360 bytes.
  std::string bomb = std::string("DRACO\x02\x02\x01\x00\x00\x00", 11) + std::string("\x22\x64\x01", 3);
  for (int i = 0; i < 102; ++i) bomb += static_cast<char>(i % 100);
  bomb += "\x01\x28";
  for (int i = 0; i < 40; ++i) bomb += std::string("\x04\x0a\x78\x00", 4) + static_cast<char>(i);
  bomb += std::string(40, '\0');  // each with the plain sequential decoder
  GltfBuilder gltf = packed_triangle(bomb);
  gltf.document["accessors"][0]["count"] = 100;
  EXPECT_THAT(refusal(gltf.document), HasSubstr("unpacks to more than 1000 times its bytes"));
}

TEST(GltfDraco, AttributesMustBeInThePackedData) {
  GltfBuilder gltf = packed_triangle(packed_bytes(draco::MESH_SEQUENTIAL_ENCODING));
  json& packed = gltf.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  packed["attributes"]["POSITION"] = 7;
  EXPECT_THAT(refusal(gltf.document), HasSubstr("attribute POSITION: does not exist in the packed data"));
  packed["attributes"]["POSITION"] = 0;
  gltf.document["accessors"][0]["type"] = "VEC2";
  EXPECT_THAT(refusal(gltf.document), HasSubstr("another number of components"));
  packed["bufferView"] = 4;
  EXPECT_THAT(refusal(gltf.document), HasSubstr("KHR_draco_mesh_compression/bufferView: bufferView 4 does not exist"));
}

}  // namespace
}  // namespace radfarm
