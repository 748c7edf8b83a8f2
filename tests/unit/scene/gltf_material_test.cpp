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
using testing::Not;
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

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
  const Material material = material_of("{}");
  EXPECT_EQ(material.base_color, Spectrum(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.specular, 1);
  EXPECT_EQ(material.ior, 1.5F);
  EXPECT_FALSE(material.is_lambertian());
}

TEST(GltfMaterial, IsExactlyLambertianOnlyWithoutMetalAndSpecular) {
  EXPECT_FALSE(material_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0}})").is_lambertian());
  const Material exact = material_of(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1],
      "metallicFactor": 0}, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})");
  EXPECT_TRUE(exact.is_lambertian());
  EXPECT_EQ(exact.base_color, Spectrum(0.5F, 0.25F, 1));
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

TEST(GltfMaterial, SpecularGlossinessBecomesADielectricOfThatReflectance) {
  const Material matt = material_of(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularFactor": [0, 0, 0]}}})");
  EXPECT_EQ(matt.base_color, Spectrum(0.1F, 0.2F, 0.3F));
  EXPECT_TRUE(matt.is_lambertian());
  const Material gloss = material_of(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"specularFactor": [0.25, 0.125, 0], "glossinessFactor": 0.75}}})");
  EXPECT_EQ(gloss.metallic, 0);
  EXPECT_FLOAT_EQ(gloss.roughness, 0.25F);
  EXPECT_FLOAT_EQ(gloss.ior, 3);  // reflects 1/4
  EXPECT_EQ(gloss.specular_color, Spectrum(1, 0.5F, 0));
}

TEST(GltfMaterial, UnlitSurfacesEmitTheirBaseColourAndReflectNothing) {
  const Material material = material_of(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]},
      "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}})");
  EXPECT_EQ(material.emission, Spectrum(0.5F, 0.25F, 1));
  EXPECT_EQ(material.base_color, Spectrum(0));
  EXPECT_TRUE(material.is_lambertian());
  EXPECT_TRUE(material.emits_from_both_sides);
}

TEST(GltfMaterial, ExtensionsThatAreLeftOutLeaveANote) {
  GltfBuilder gltf = triangle();
  gltf.document["materials"][0]["extensions"] = {{"KHR_materials_iridescence", json::object()},
                                                 {"KHR_materials_clearcoat", json::object()},
                                                 {"KHR_materials_unlit", json::object()}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene);
  EXPECT_THAT(scene->notes, Contains("Material extension KHR_materials_iridescence is ignored."));
  EXPECT_TRUE(scene->materials[0].asks_for(Material::kIridescence));
  EXPECT_FALSE(scene->materials[0].asks_for(Material::kScatteringInside));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("KHR_materials_unlit")));
  EXPECT_THAT(scene->notes, Not(Contains(HasSubstr("KHR_materials_clearcoat"))));
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
  EXPECT_EQ(scene->materials[0].emission_texture.uv_set, 1U);
  EXPECT_EQ(scene->meshes[0].uv[0][1], Vec2(1, 0));
  EXPECT_EQ(scene->meshes[0].uv[1][1], Vec2(5, 5));
}

TEST(GltfMaterial, AnImageUsedAsColourAndAsDataIsStoredOnceForEach) {
  GltfBuilder gltf = textured();
  json& material = gltf.document["materials"][0];
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->textures.size(), 2U);
  const Material& read = scene->materials[0];
  EXPECT_TRUE(scene->textures[read.base_texture.texture].is_srgb);
  EXPECT_FALSE(scene->textures[read.metallic_roughness_texture.texture].is_srgb);
  EXPECT_EQ(read.normal_texture, read.metallic_roughness_texture);
  EXPECT_EQ(read.normal_scale, 0.5F);
}

TEST(GltfMaterial, TexturesOnFactorsOfZeroAreNotRead) {
  GltfBuilder gltf = textured();
  gltf.document["images"][0]["uri"] = "missing.png";
  const json texture = {{"index", 0}};
  gltf.document["materials"][0] = json::parse(R"({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1],
      "metallicFactor": 0}, "extensions": {"KHR_materials_specular": {"specularFactor": 0},
      "KHR_materials_transmission": {}, "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {}}})");
  json& material = gltf.document["materials"][0];
  material["emissiveTexture"] = texture;
  material["normalTexture"] = {{"index", 0}, {"scale", 0}};
  for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) {
    material["pbrMetallicRoughness"][key] = texture;
  }
  json& extensions = material["extensions"];
  extensions["KHR_materials_specular"]["specularTexture"] = texture;
  extensions["KHR_materials_transmission"]["transmissionTexture"] = texture;
  extensions["KHR_materials_clearcoat"]["clearcoatTexture"] = texture;
  extensions["KHR_materials_sheen"]["sheenColorTexture"] = texture;
  EXPECT_EQ(test::refusal(gltf.document), "loads");
}

TEST(GltfMaterial, TextureTransformsAreKeptWithTheUse) {
  GltfBuilder gltf = textured();
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0}}, {"scale", {2, 3}}, {"rotation", 1.5707963267948966}, {"texCoord", 1}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  const TextureUse& use = scene->materials[0].base_texture;
  EXPECT_EQ(use.uv_set, 1U);
  // (u, v) is scaled to (2u, 3v), turned to (3v, -2u), moved to (3v + 0.5, -2u).
  const float expected[6] = {0, 3, 0.5F, -2, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(use.map[i], expected[i], 1e-6F) << i;
  EXPECT_TRUE(scene->meshes[0].uv[0].empty());
  EXPECT_EQ(scene->meshes[0].uv[1][1], Vec2(5, 5));
}

TEST(GltfMaterial, AThirdSetOfCoordinatesTakesAFreePlace) {
  GltfBuilder gltf = textured();
  json& primitive = gltf.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_3"] = gltf.add<float>({7, 7, 7, 7, 7, 7}, 5126, "VEC2", 3);
  json& material = gltf.document["materials"][0];
  material["normalTexture"] = {{"index", 0}, {"texCoord", 3}};
  const Result<Scene> scene = load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].normal_texture.uv_set, 1U);
  EXPECT_EQ(scene->meshes[0].uv[1][0], Vec2(7, 7));
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}, {"texCoord", 1}};
  EXPECT_THAT(test::refusal(gltf.document), StartsWith("/materials/0: its textures use TEXCOORD_3 besides two"));
}

TEST(GltfMaterial, ATextureOfAnotherFormatNamesItsExtension) {
  GltfBuilder gltf = textured();
  gltf.document["textures"] = json::parse(R"([{"extensions": {"KHR_texture_basisu": {"source": 0}}}])");
  EXPECT_THAT(test::refusal(gltf.document), HasSubstr("KHR_texture_basisu, which is not supported"));
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
