#include "scene/specular_layer.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

/// The scene of a triangle whose material has these extensions.
Scene scene_with(const char* extensions) {
  test::GltfBuilder gltf = test::triangle();
  gltf.document["materials"][0]["extensions"] = json::parse(extensions);
  Result<Scene> scene = test::load(gltf.document);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : Scene{};
}

Material material_with(const char* extensions) { return scene_with(extensions).materials.at(0); }

TEST(GltfLayers, SpecularIsRead) {
  const Material material = material_with(
      R"({"KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0]},
          "KHR_materials_ior": {"ior": 1.8}})");
  EXPECT_EQ(material.specular, 0.5F);
  EXPECT_EQ(material.specular_color, Spectrum(1, 0.5F, 0));
  EXPECT_EQ(material.ior, 1.8F);
}

TEST(GltfLayers, IndicesOfRefractionOutsideTheirRangeHaveAMeaning) {
  EXPECT_NEAR(reflectance_of_ior(material_with(R"({"KHR_materials_ior": {"ior": 0}})").ior), 0.99, 1e-5);
  const Scene scene = scene_with(R"({"KHR_materials_ior": {"ior": 0.5}})");
  EXPECT_EQ(scene.materials[0].ior, 1);
  EXPECT_THAT(scene.notes, Contains(HasSubstr("below 1")));
}

TEST(GltfLayers, TransmissionIsThinWithoutThickness) {
  const Material pane = material_with(R"({"KHR_materials_transmission": {"transmissionFactor": 0.75}})");
  EXPECT_EQ(pane.transmission, 0.75F);
  EXPECT_FALSE(pane.has_volume);
  const Material body = material_with(R"({"KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationColor": [0.5, 1, 0.25],
      "attenuationDistance": 2}})");
  EXPECT_TRUE(body.has_volume);
  EXPECT_EQ(body.attenuation_color, Spectrum(0.5F, 1, 0.25F));
  EXPECT_EQ(body.attenuation_distance, 2);
  EXPECT_EQ(material_with(R"({"KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_volume": {"thicknessFactor": 1}})")
                .attenuation_distance,
            0);
}

TEST(GltfLayers, ClearcoatSheenAndAnisotropyAreRead) {
  const Material material = material_with(
      R"({"KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25},
          "KHR_materials_sheen": {"sheenColorFactor": [1, 0, 0.5], "sheenRoughnessFactor": 0.75},
          "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1.5}})");
  EXPECT_EQ(material.clearcoat, 0.5F);
  EXPECT_EQ(material.clearcoat_roughness, 0.25F);
  EXPECT_EQ(material.sheen_color, Spectrum(1, 0, 0.5F));
  EXPECT_EQ(material.sheen_roughness, 0.75F);
  EXPECT_EQ(material.anisotropy, 0.5F);
  EXPECT_EQ(material.anisotropy_rotation, 1.5F);
}

TEST(GltfLayers, EachTextureHasItsEncoding) {
  test::GltfBuilder gltf = test::triangle();
  gltf.document["images"] = {{{"uri", "data:image/png;base64," + test::base64(test::tiny_png())}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["materials"][0]["extensions"] = json::parse(
      R"({"KHR_materials_specular": {"specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
          "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 0}},
          "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 1,
              "clearcoatTexture": {"index": 0}, "clearcoatRoughnessTexture": {"index": 0}},
          "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 1,
              "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 0}}})");
  const Result<Scene> scene = test::load(gltf.document);
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& m = scene->materials[0];
  const auto is_srgb = [&](const TextureUse& use) { return scene->textures.at(use.texture).is_srgb; };
  for (const TextureUse* use : {&m.specular_color_texture, &m.sheen_color_texture}) EXPECT_TRUE(is_srgb(*use));
  for (const TextureUse* use : {&m.specular_texture, &m.transmission_texture, &m.clearcoat_texture,
                                &m.clearcoat_roughness_texture, &m.sheen_roughness_texture}) {
    EXPECT_FALSE(is_srgb(*use));
  }
  EXPECT_EQ(scene->textures.size(), 2U);
}

TEST(SpecularLayer, ReflectsWhatItIsToldTo) {
  for (const double wanted : {0.01, 0.04, 0.3, 0.9}) {
    Material material;
    set_specular_layer(SpectrumD(wanted, wanted / 2, 0), 1.5, material);
    EXPECT_NEAR(reflectance_of_ior(material.ior) * material.specular_color.r, wanted, 1e-6);
    EXPECT_NEAR(material.specular_color.g / material.specular_color.r, 0.5, 1e-6);
    EXPECT_LE(material.specular_color.r, 1);
    EXPECT_GE(material.ior, 1.5F);
  }
}

}  // namespace
}  // namespace radfarm
