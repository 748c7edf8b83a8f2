#include "scene/obj_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/specular_layer.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

/// The material that an MTL file's lines after "newmtl a" make.
Material material_of(const std::string& lines) {
  const test::Folder folder;
  folder.write("scene.mtl", "newmtl a\n" + lines);
  const Result<Scene> scene =
      load_scene(folder.write("scene.obj", "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? scene->materials[0] : Material{};
}

double reflected(const Material& material) { return reflectance_of_ior(material.ior) * material.specular_color.r; }

TEST(ObjLayers, WithoutKsExactlyLambertian) {
  const Material material = material_of("Kd 0.8 0.4 0.2\nKe 5 6 7\nd 0.5\nillum 2\nNs 300\nNi 1.5\n");
  EXPECT_TRUE(material.is_lambertian());
  EXPECT_EQ(material.base_color, Spectrum(0.8F, 0.4F, 0.2F));
  EXPECT_EQ(material.emission, Spectrum(5, 6, 7));
  EXPECT_EQ(material.alpha_mode, Material::Alpha::kBlend);
  EXPECT_EQ(material.alpha, 0.5F);
}

TEST(ObjLayers, IlluminationModelsBelowTwoIgnoreKs) {
  EXPECT_TRUE(material_of("Kd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nillum 1\n").is_lambertian());
  EXPECT_FALSE(material_of("Kd 0.4 0.4 0.4\nKs 0.5 0.5 0.5\n").is_lambertian()) << "without illum, Ks counts";
}

TEST(ObjLayers, KsIsWhatTheLayerReflectsAtNormalIncidence) {
  const Material material = material_of("Kd 0.4 0.4 0.4\nKs 0.2 0.1 0.05\nillum 2\nNs 48\n");
  EXPECT_EQ(material.specular, 1);
  EXPECT_NEAR(reflected(material), 0.2, 1e-6);
  EXPECT_NEAR(material.specular_color.g, 0.5, 1e-6);
  EXPECT_FLOAT_EQ(material.roughness, std::sqrt(0.2F));  // alpha = sqrt(2 / 50)
}

TEST(ObjLayers, NiHoldsWhereItAgreesWithKs) {
  const Material glazed = material_of("Kd 0.4 0.4 0.4\nKs 0.03 0.03 0.03\nNi 1.5\nillum 2\n");
  EXPECT_EQ(glazed.ior, 1.5F);
  EXPECT_NEAR(reflected(glazed), 0.03, 1e-6);
  EXPECT_GT(material_of("Kd 0.4 0.4 0.4\nKs 0.5 0.5 0.5\nNi 1.5\nillum 2\n").ior, 5);
}

TEST(ObjLayers, ASumAboveOneIsScaledAsAWhole) {
  const Material material = material_of("Kd 0.8 0.4 0\nKs 0.8 0.4 0\nillum 2\n");
  EXPECT_EQ(material.base_color, Spectrum(0.5F, 0.25F, 0));
  EXPECT_NEAR(reflected(material), 0.5, 1e-6);
}

TEST(ObjLayers, MirrorsAreMetalWhereKdIsBlack) {
  const Material mirror = material_of("Kd 0 0 0\nKs 0.9 0.8 0.7\nillum 3\n");
  EXPECT_EQ(mirror.metallic, 1);
  EXPECT_EQ(mirror.roughness, 0);
  EXPECT_EQ(mirror.base_color, Spectrum(0.9F, 0.8F, 0.7F));
  const Material lacquer = material_of("Kd 0.5 0 0\nKs 0.1 0.1 0.1\nNs 10\nillum 5\n");
  EXPECT_EQ(lacquer.metallic, 0);
  EXPECT_EQ(lacquer.roughness, 0);
  EXPECT_NEAR(reflected(lacquer), 0.1, 1e-6);
}

TEST(ObjLayers, GlassPassesTfAndKeepsItsCoverage) {
  const Material body = material_of("Kd 0.5 0.5 0.5\nTf 1 0.5 0.25\nd 0.1\nNi 1.6\nillum 7\n");
  EXPECT_EQ(body.transmission, 1);
  EXPECT_EQ(body.base_color, Spectrum(1, 0.5F, 0.25F));
  EXPECT_EQ(body.roughness, 0);
  EXPECT_EQ(body.ior, 1.6F);
  EXPECT_TRUE(body.has_volume);
  EXPECT_EQ(body.alpha, 1);
  EXPECT_EQ(body.alpha_mode, Material::Alpha::kOpaque);
  EXPECT_EQ(material_of("illum 4\nNi 1.5\n").base_color, Spectrum(1)) << "without Tf all passes";
  EXPECT_FALSE(material_of("illum 4\nNi 1.5\n").has_volume);
  EXPECT_FALSE(material_of("illum 6\nNi 1\n").has_volume);
}

}  // namespace
}  // namespace radfarm
