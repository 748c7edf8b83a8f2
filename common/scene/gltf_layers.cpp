#include <algorithm>
#include <string>

#include "scene/draft_scene.h"
#include "scene/gltf_material.h"
#include "scene/gltf_values.h"
#include "scene/specular_layer.h"

namespace radfarm {
namespace {

using nlohmann::json;

float number(const json& object, const char* key, double otherwise) {
  return static_cast<float>(gltf_number(object, key, otherwise));
}

Status read_specular(const json& source, GltfTextureReader& textures, Material& material) {
  const json& specular = gltf_extension(source, "KHR_materials_specular");
  material.specular = number(specular, "specularFactor", 1);
  material.specular_color = Spectrum(gltf_color(specular, "specularColorFactor", 1));
  if (material.specular == 0) return {};
  RADFARM_TRY(material.specular_texture, textures.use(specular, "specularTexture", false));
  if (is_black(material.specular_color)) return {};
  RADFARM_TRY(material.specular_color_texture, textures.use(specular, "specularColorTexture", true));
  return {};
}

/// The file's ior 0 says that all light is reflected at normal incidence, which is as good as the largest ior.
void read_ior(const json& source, Scene& scene, Material& material) {
  const double ior = gltf_number(gltf_extension(source, "KHR_materials_ior"), "ior", 1.5);
  if (ior > 0 && ior < 1) add_note(scene, "Indices of refraction below 1 (KHR_materials_ior) are taken as 1.");
  material.ior = static_cast<float>(ior == 0 ? ior_of_reflectance(1) : std::max(ior, 1.0));
}

Status read_transmission(const json& source, GltfTextureReader& textures, Material& material) {
  const json& transmission = gltf_extension(source, "KHR_materials_transmission");
  material.transmission = number(transmission, "transmissionFactor", 0);
  if (material.transmission == 0) return {};
  RADFARM_TRY(material.transmission_texture, textures.use(transmission, "transmissionTexture", false));
  // How thick the inside is, the mesh says; the file's thickness only tells a volume from a thin pane.
  const json& volume = gltf_extension(source, "KHR_materials_volume");
  material.has_volume = gltf_number(volume, "thicknessFactor", 0) > 0;
  material.attenuation_color = Spectrum(gltf_color(volume, "attenuationColor", 1));
  material.attenuation_distance = number(volume, "attenuationDistance", 0);
  return {};
}

Status read_clearcoat(const json& source, GltfTextureReader& textures, Scene& scene, Material& material) {
  const json& clearcoat = gltf_extension(source, "KHR_materials_clearcoat");
  material.clearcoat = number(clearcoat, "clearcoatFactor", 0);
  if (material.clearcoat == 0) return {};
  material.clearcoat_roughness = number(clearcoat, "clearcoatRoughnessFactor", 0);
  RADFARM_TRY(material.clearcoat_texture, textures.use(clearcoat, "clearcoatTexture", false));
  if (clearcoat.contains("clearcoatNormalTexture")) {
    add_note(scene, "Normal textures of clear coats are ignored: the coat is smooth.");
  }
  if (material.clearcoat_roughness == 0) return {};
  RADFARM_TRY(material.clearcoat_roughness_texture, textures.use(clearcoat, "clearcoatRoughnessTexture", false));
  return {};
}

Status read_sheen(const json& source, GltfTextureReader& textures, Material& material) {
  const json& sheen = gltf_extension(source, "KHR_materials_sheen");
  material.sheen_color = Spectrum(gltf_color(sheen, "sheenColorFactor", 0));
  if (is_black(material.sheen_color)) return {};
  material.sheen_roughness = number(sheen, "sheenRoughnessFactor", 0);
  RADFARM_TRY(material.sheen_color_texture, textures.use(sheen, "sheenColorTexture", true));
  if (material.sheen_roughness == 0) return {};
  RADFARM_TRY(material.sheen_roughness_texture, textures.use(sheen, "sheenRoughnessTexture", false));
  return {};
}

void read_anisotropy(const json& source, Scene& scene, Material& material) {
  const json& anisotropy = gltf_extension(source, "KHR_materials_anisotropy");
  material.anisotropy = number(anisotropy, "anisotropyStrength", 0);
  if (material.anisotropy == 0) return;
  material.anisotropy_rotation = number(anisotropy, "anisotropyRotation", 0);
  if (anisotropy.contains("anisotropyTexture")) {
    add_note(scene, "Anisotropy textures are ignored: strength and rotation hold everywhere.");
  }
}

}  // namespace

Status read_gltf_layers(const json& source, GltfTextureReader& textures, Scene& scene, Material& material) {
  RADFARM_TRY_STATUS(read_specular(source, textures, material));
  read_ior(source, scene, material);
  RADFARM_TRY_STATUS(read_transmission(source, textures, material));
  RADFARM_TRY_STATUS(read_clearcoat(source, textures, scene, material));
  RADFARM_TRY_STATUS(read_sheen(source, textures, material));
  read_anisotropy(source, scene, material);
  return {};
}

}  // namespace radfarm
