#include "scene/gltf_material.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::load;
using test::triangle;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

Material material_of(const char* text) {
  GltfBuilder gltf = triangle();
  gltf.document["materials"][0] = json::parse(text);
  const Result<Scene> scene = load(gltf.document);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? scene->materials[0] : Material{};
}

TEST(GltfMaterial, AnEmissionOfStrengthZeroIsSwitchedOff) {
  EXPECT_TRUE(material_of(R"({"emissiveFactor": [1, 0.5, 0],
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 0}}})").is_switched_off);
  EXPECT_FALSE(material_of(R"({"emissiveFactor": [0, 0, 0],
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 0}}})").is_switched_off);
  EXPECT_FALSE(material_of(R"({"emissiveFactor": [1, 0.5, 0]})").is_switched_off);
}

TEST(GltfMaterial, IsExactlyLambertianOnlyWithoutMetalAndSpecular) {
  EXPECT_TRUE(material_of("{}").folds_gloss_into_diffuse);
  EXPECT_TRUE(material_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0}})").folds_gloss_into_diffuse);
  const Material exact = material_of(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1],
      "metallicFactor": 0}, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})");
  EXPECT_FALSE(exact.folds_gloss_into_diffuse);
  EXPECT_EQ(exact.reflectance, Spectrum(0.5F, 0.25F, 1));
}

TEST(GltfMaterial, EmissionIsFactorTimesStrength) {
  const Material material = material_of(R"({"emissiveFactor": [1, 0.5, 0], "doubleSided": true,
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 20}}})");
  EXPECT_EQ(material.emission, Spectrum(20, 10, 0));
  EXPECT_TRUE(material.emits_from_both_sides);
}

TEST(GltfMaterial, AlphaCountsOnlyInMaskAndBlend) {
  EXPECT_EQ(material_of(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}})").alpha, 1);
  const Material mask = material_of(R"({"alphaMode": "MASK", "alphaCutoff": 0.3,
                                        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}})");
  EXPECT_EQ(mask.alpha_mode, Material::Alpha::kMask);
  EXPECT_EQ(mask.alpha, 0.25F);
  EXPECT_EQ(mask.alpha_cutoff, 0.3F);
}

TEST(GltfMaterial, SpecularGlossinessGivesItsDiffuseColour) {
  const Material material = material_of(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularFactor": [0, 0, 0]}}})");
  EXPECT_EQ(material.reflectance, Spectrum(0.1F, 0.2F, 0.3F));
  EXPECT_FALSE(material.folds_gloss_into_diffuse);
}

TEST(GltfMaterial, ExtensionsThatMatterLeaveANote) {
  GltfBuilder gltf = triangle();
  gltf.document["materials"][0]["extensions"] = {{"KHR_materials_transmission", json::object()},
                                                 {"KHR_materials_unlit", json::object()}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene);
  EXPECT_THAT(scene->notes, Contains(HasSubstr("KHR_materials_transmission")));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("KHR_materials_unlit")));
}

/// The triangle with uv (0,0) (1,0) (0,1) in set 0, uv (5,5) in set 1, and a texture.
GltfBuilder textured() {
  GltfBuilder gltf = triangle();
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = gltf.add<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  attributes["TEXCOORD_1"] = gltf.add<float>({5, 5, 5, 5, 5, 5}, 5126, "VEC2", 3);
  gltf.document["images"] = {{{"uri", "data:image/png;base64," + test::base64(test::tiny_png())}}};
  gltf.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  gltf.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return gltf;
}

TEST(GltfMaterial, TexturesAreDecodedOnceWithTheirWrapModes) {
  GltfBuilder gltf = textured();
  gltf.document["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  gltf.document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->textures.size(), 1U);
  const Texture& texture = scene->textures[0];
  EXPECT_EQ(texture.width, 2U);
  EXPECT_EQ(texture.texels[1], (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
  EXPECT_EQ(texture.wrap_u, Texture::Wrap::kClamp);
  EXPECT_EQ(texture.wrap_v, Texture::Wrap::kMirror);
  EXPECT_TRUE(texture.is_srgb);
  EXPECT_EQ(scene->materials[0].emission_uv, 1U);
  EXPECT_EQ(scene->meshes[0].uv[0][1], Vec2(1, 0));
  EXPECT_EQ(scene->meshes[0].uv[1][1], Vec2(5, 5));
}

TEST(GltfMaterial, TextureTransformsAreBakedIntoTheCoordinates) {
  GltfBuilder gltf = textured();
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0}}, {"scale", {2, 3}}, {"rotation", 1.5707963267948966}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  // (1, 0) is scaled to (2, 0), turned to (0, -2), moved to (0.5, -2).
  EXPECT_NEAR(scene->meshes[0].uv[0][1].x, 0.5, 1e-6);
  EXPECT_NEAR(scene->meshes[0].uv[0][1].y, -2, 1e-6);
  EXPECT_NEAR(scene->meshes[0].uv[0][2].x, 3.5, 1e-6);
}

TEST(GltfMaterial, ABrokenImageIsAnErrorOnlyWhenAMaterialUsesIt) {
  GltfBuilder gltf = textured();
  gltf.document["images"][0]["uri"] = "data:image/png;base64,AAAA";
  EXPECT_THAT(test::refusal(gltf.document), StartsWith("/materials/0: /images/0: cannot read image"));
  gltf.document["images"][0]["uri"] = "missing.png";
  EXPECT_THAT(test::refusal(gltf.document), HasSubstr("missing.png: cannot open"));
  gltf.document["materials"][0].erase("pbrMetallicRoughness");
  EXPECT_EQ(test::refusal(gltf.document), "loads");
}

TEST(GltfMaterial, ATexturedMeshWithoutCoordinatesGetsSomeWithANote) {
  GltfBuilder gltf = textured();
  gltf.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].uv[0].size(), 3U);
  EXPECT_THAT(scene->notes, Contains(HasSubstr("without TEXCOORD_0")));
}

}  // namespace
}  // namespace radfarm
