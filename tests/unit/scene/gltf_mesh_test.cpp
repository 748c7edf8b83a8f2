#include "scene/gltf_mesh.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using test::GltfBuilder;
using test::load;
using test::refusal;
using test::triangle;
using testing::ElementsAre;
using testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

/// Five points of a strip along x: 0, 2, 4 below, 1, 3 above.
GltfBuilder strip(int mode) {
  GltfBuilder gltf = triangle();
  const auto positions = gltf.add_vec3({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0});
  gltf.document["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
  return gltf;
}

TEST(GltfMesh, StripsKeepTheirOrientation) {
  const Result<Scene> scene = load(strip(5).document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}, Triangle{2, 3, 4}));
}

TEST(GltfMesh, FansTurnAboutTheirFirstCorner) {
  const Result<Scene> scene = load(strip(6).document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].triangles, ElementsAre(Triangle{1, 2, 0}, Triangle{2, 3, 0}, Triangle{3, 4, 0}));
}

TEST(GltfMesh, DegenerateTrianglesOfAStripAreDroppedWithANote) {
  GltfBuilder gltf = strip(5);
  const auto indices = gltf.add<std::uint16_t>({0, 1, 2, 2, 3, 4}, 5123, "SCALAR", 6);
  gltf.document["meshes"][0]["primitives"][0]["indices"] = indices;
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].triangles.size(), 2U);
  EXPECT_THAT(scene->notes, ElementsAre("2 triangles without area are dropped."));
}

TEST(GltfMesh, PointsAndLinesAreSkippedWithANote) {
  const Result<Scene> scene = load(strip(1).document);
  ASSERT_TRUE(scene);
  EXPECT_TRUE(scene->meshes.empty());
  EXPECT_THAT(scene->notes, ElementsAre(HasSubstr("Points and lines")));
}

TEST(GltfMesh, AnIndexBeyondTheVerticesIsNamed) {
  GltfBuilder gltf = triangle();
  const auto indices = gltf.add<std::uint16_t>({0, 1, 7}, 5123, "SCALAR", 3);
  gltf.document["meshes"][0]["primitives"][0]["indices"] = indices;
  EXPECT_EQ(refusal(gltf.document),
            "/meshes/0/primitives/0/indices: value 7 at position 2 is out of range (there are 3 vertices)");
}

TEST(GltfMesh, ThePrimitiveRestartValueIsRefused) {
  GltfBuilder gltf = triangle();
  const auto positions = gltf.add_vec3(std::vector<float>(std::size_t{256} * 3, 0.5F));
  const auto indices = gltf.add<std::uint8_t>({0, 1, 255}, 5121, "SCALAR", 3);
  gltf.document["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
  EXPECT_THAT(refusal(gltf.document), HasSubstr("primitive restart"));
}

TEST(GltfMesh, NormalsBecomeUnitAndZeroOnesComeFromTheSurface) {
  GltfBuilder gltf = triangle();
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = gltf.add_vec3({0, 3, 4, 0, 0, 0, 1, 0, 0});
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].normals, ElementsAre(Vec3(0, .6F, .8F), Vec3(0, 0, 1), Vec3(1, 0, 0)));
}

TEST(GltfMesh, VertexColoursAreReadAsRgbOrRgbaAndClamped) {
  GltfBuilder gltf = triangle();
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      gltf.add<std::uint8_t>({255, 0, 0, 51, 0, 255, 0, 255, 0, 0, 255, 0}, 5121, "VEC4", 3);
  gltf.document["accessors"].back()["normalized"] = true;
  Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].colors[0], ElementsAre(1.0F, 0.0F, 0.0F, testing::FloatEq(0.2F)));
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = gltf.add_vec3({2, 0, 0, 1, 1, 1, 0, 0, -1});
  scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->meshes[0].colors[0], ElementsAre(1.0F, 0.0F, 0.0F, 1.0F));
  EXPECT_THAT(scene->notes, testing::Contains(HasSubstr("clamped")));
}

TEST(GltfMesh, MorphTargetsApplyTheirDefaultWeights) {
  GltfBuilder gltf = triangle();
  const auto target = gltf.add_vec3({0, 0, 0, 4, 0, 0, 0, 0, 0});
  gltf.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
  gltf.document["meshes"][0]["weights"] = {0.5};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_DOUBLE_EQ(test::placed(*scene, 0, 1).x, 3);
}

TEST(GltfMesh, APrimitiveWithoutMaterialIsRoughWhiteMetalAsGltfSays) {
  GltfBuilder gltf = triangle();
  gltf.document["meshes"][0]["primitives"][0].erase("material");
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& material = scene->materials[scene->meshes[0].material];
  EXPECT_EQ(material.base_color, Spectrum(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
}

/// The triangle with normals, coordinates and tangents, and a material with a normal texture.
GltfBuilder with_tangents(const std::vector<float>& tangents) {
  GltfBuilder gltf = triangle();
  nlohmann::json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = gltf.add_vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  attributes["TANGENT"] = gltf.add(tangents, 5126, "VEC4", 3);
  attributes["TEXCOORD_0"] = gltf.add<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  gltf.document["images"] = {{{"uri", "data:image/png;base64," + test::base64(test::tiny_png())}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["materials"][0]["normalTexture"] = {{"index", 0}};
  return gltf;
}

TEST(GltfMesh, TangentsBecomeUnitWhereAMaterialNeedsThem) {
  GltfBuilder gltf = with_tangents({2, 0, 0, 1, 0, 3, 0, -1, 1, 0, 0, 1});
  Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->meshes[0].tangents.size(), 3U);
  EXPECT_THAT(scene->meshes[0].tangents[0], ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(scene->meshes[0].tangents[1], ElementsAre(0, 1, 0, -1));
  gltf.document["materials"][0].erase("normalTexture");
  scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->meshes[0].tangents.empty());
  EXPECT_TRUE(scene->meshes[0].uv[0].empty());
}

TEST(GltfMesh, TangentsThatAreNoneAreAllDropped) {
  for (const std::vector<float>& bad : {std::vector<float>{1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1},
                                        std::vector<float>{1, 0, 0, 1, 1, 0, 0, 0.5F, 1, 0, 0, 1}}) {
    const Result<Scene> scene = load(with_tangents(bad).document);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->meshes[0].tangents.empty());
    EXPECT_TRUE(scene->notes.empty());
  }
}

TEST(GltfMesh, QuantizedAttributesAreReadAsTheyAreScaled) {
  GltfBuilder gltf = with_tangents(std::vector<float>(12, 1.0F));
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  nlohmann::json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  const auto add_normalized = [&](const auto& values, int type, const char* shape) {
    const auto accessor = gltf.add(values, type, shape, 3);
    gltf.document["accessors"].back()["normalized"] = true;
    return accessor;
  };
  attributes["POSITION"] = gltf.add<std::int16_t>({-5, 0, 0, 7, 0, 0, 0, 300, 0}, 5122, "VEC3", 3);
  attributes["NORMAL"] = add_normalized(std::vector<std::int8_t>{0, 0, 127, 0, 0, 127, 0, 0, 127}, 5120, "VEC3");
  attributes["TEXCOORD_0"] = add_normalized(std::vector<std::uint16_t>{0, 65535, 0, 0, 65535, 0}, 5123, "VEC2");
  attributes["TANGENT"] = add_normalized(
      std::vector<std::int8_t>{127, 0, 0, 127, 127, 0, 0, -127, 127, 0, 0, 127}, 5120, "VEC4");
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(test::placed(*scene, 0, 0).x, -5, 1e-5);
  EXPECT_NEAR(test::placed(*scene, 0, 2).y, 300, 1e-4);
  EXPECT_EQ(scene->meshes[0].normals[0], Vec3(0, 0, 1));
  EXPECT_EQ(scene->meshes[0].uv[0][0], Vec2(0, 1));
  EXPECT_THAT(scene->meshes[0].tangents[1], ElementsAre(1, 0, 0, -1));
}

}  // namespace
}  // namespace radfarm
