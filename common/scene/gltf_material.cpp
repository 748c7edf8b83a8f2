#include "scene/gltf_material.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "scene/draft_scene.h"
#include "scene/gltf_values.h"
#include "scene/specular_layer.h"
#include "scene/texture_uses.h"

namespace radfarm {
namespace {

using nlohmann::json;

constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* kUnlit = "KHR_materials_unlit";

Material::Alpha alpha_mode(const json& source) {
  const std::string mode = gltf_text(source, "alphaMode");
  if (mode == "MASK") return Material::Alpha::kMask;
  return mode == "BLEND" ? Material::Alpha::kBlend : Material::Alpha::kOpaque;
}

/// Colour and coverage; `object` is pbrMetallicRoughness or the specular-glossiness extension.
Status read_base(const json& source, const json& object, const char* factor, const char* texture,
                 GltfTextureReader& textures, Material& material) {
  material.base_color = Spectrum(gltf_color(object, factor, 1));
  material.alpha_mode = alpha_mode(source);
  const bool is_opaque = material.alpha_mode == Material::Alpha::kOpaque;
  material.alpha = is_opaque ? 1.0F : static_cast<float>(gltf_element(object, factor, 3, 1));
  material.alpha_cutoff = static_cast<float>(gltf_number(source, "alphaCutoff", 0.5));
  if (is_opaque && is_black(material.base_color)) return {};
  RADFARM_TRY(material.base_texture, textures.use(object, texture, true));
  return {};
}

Status read_metallic_roughness(const json& source, GltfTextureReader& textures, Material& material) {
  const json& pbr = gltf_object(source, "pbrMetallicRoughness");
  RADFARM_TRY_STATUS(read_base(source, pbr, "baseColorFactor", "baseColorTexture", textures, material));
  material.metallic = static_cast<float>(gltf_number(pbr, "metallicFactor", 1));
  material.roughness = static_cast<float>(gltf_number(pbr, "roughnessFactor", 1));
  return {};
}

/// KHR_materials_pbrSpecularGlossiness as a dielectric whose layer reflects specularFactor at normal incidence.
Status read_glossiness(const json& source, GltfTextureReader& textures, Scene& scene, Material& material) {
  const json& glossiness = gltf_extension(source, kGlossiness);
  RADFARM_TRY_STATUS(read_base(source, glossiness, "diffuseFactor", "diffuseTexture", textures, material));
  material.roughness = static_cast<float>(1 - gltf_number(glossiness, "glossinessFactor", 1));
  set_specular_layer(gltf_color(glossiness, "specularFactor", 1), 1.5, material);
  if (glossiness.contains("specularGlossinessTexture") && material.specular > 0) {
    add_note(scene, std::string("Textures of specular colour and glossiness (") + kGlossiness +
                        ") are ignored: their factors hold everywhere.");
  }
  return {};
}

Status read_emission(const json& source, GltfTextureReader& textures, Material& material) {
  const SpectrumD factor = gltf_color(source, "emissiveFactor", 0);
  const json& extension = gltf_extension(source, "KHR_materials_emissive_strength");
  material.emission = Spectrum(factor * gltf_number(extension, "emissiveStrength", 1));
  material.is_switched_off = is_black(material.emission) && !is_black(Spectrum(factor));
  if (is_black(material.emission)) return {};
  RADFARM_TRY(material.emission_texture, textures.use(source, "emissiveTexture", true));
  return {};
}

Status read_normals(const json& source, GltfTextureReader& textures, Material& material) {
  material.normal_scale = static_cast<float>(gltf_number(gltf_object(source, "normalTexture"), "scale", 1));
  if (material.normal_scale == 0) return {};
  RADFARM_TRY(material.normal_texture, textures.use(source, "normalTexture", false));
  return {};
}

/// KHR_materials_unlit: what the viewer shall see is what the surface emits, so nothing else may light it.
void make_unlit(Material& material, Scene& scene) {
  material.emission = material.base_color;
  material.emission_texture = material.base_texture;
  material.base_color = Spectrum(0);
  if (material.alpha_mode == Material::Alpha::kOpaque) material.base_texture = {};
  material.emits_from_both_sides = true;
  add_note(scene, std::string("Surfaces with ") + kUnlit +
                      " emit their base colour, in cd/m^2, from both sides and reflect nothing.");
}

std::uint32_t unsimulated_by(std::string_view extension) {
  if (extension == "KHR_materials_dispersion") return Material::kDispersion;
  if (extension == "KHR_materials_iridescence") return Material::kIridescence;
  const bool is_inside = extension == "KHR_materials_diffuse_transmission" || extension == "KHR_materials_volume_scatter" ||
                         extension == "KHR_materials_subsurface";
  return is_inside ? Material::kScatteringInside : 0;
}

void note_extensions(const json& source, Scene& scene, Material& material) {
  constexpr std::array<std::string_view, 10> kRead = {
      "KHR_materials_emissive_strength", "KHR_materials_specular",  "KHR_materials_ior",   "KHR_materials_transmission",
      "KHR_materials_volume",            "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
      kUnlit,                            kGlossiness};
  for (const auto& [name, value] : gltf_object(source, "extensions").items()) {
    if (!name.starts_with("KHR_materials_") || std::find(kRead.begin(), kRead.end(), name) != kRead.end()) continue;
    add_note(scene, "Material extension " + name.substr(0, 60) + " is ignored.");
    material.unsimulated |= unsimulated_by(name);
  }
}

Result<Material> read_material(const json& source, GltfTextureReader& textures, Scene& scene) {
  Material material;
  material.name = gltf_text(source, "name");
  note_extensions(source, scene, material);
  if (has_gltf_extension(source, kUnlit)) {
    RADFARM_TRY_STATUS(read_metallic_roughness(source, textures, material));
    material.metallic = 0;
    material.roughness = 1;
    make_unlit(material, scene);
    return material;
  }
  const auto doubled = source.find("doubleSided");
  material.emits_from_both_sides = doubled != source.end() && doubled->is_boolean() && doubled->get<bool>();
  RADFARM_TRY_STATUS(read_emission(source, textures, material));
  RADFARM_TRY_STATUS(read_normals(source, textures, material));
  if (has_gltf_extension(source, kGlossiness)) {
    RADFARM_TRY_STATUS(read_glossiness(source, textures, scene, material));
    return material;
  }
  RADFARM_TRY_STATUS(read_metallic_roughness(source, textures, material));
  RADFARM_TRY_STATUS(read_gltf_layers(source, textures, scene, material));
  // Roughness is that of the metal, the layer and the glass; without them neither channel is looked up.
  const bool is_glossy = material.metallic > 0 || material.specular > 0 || material.transmission > 0;
  if (is_glossy && (material.metallic > 0 || material.roughness > 0)) {
    const json& pbr = gltf_object(source, "pbrMetallicRoughness");
    RADFARM_TRY(material.metallic_roughness_texture, textures.use(pbr, "metallicRoughnessTexture", false));
  }
  return material;
}

/// Replaces the file's set numbers in the material's texture uses by the two that a Mesh has.
Result<GltfUvSets> assign_uv_sets(Material& material) {
  GltfUvSets sets = {kNone, kNone};
  for (const TextureUse* use : texture_uses(material)) {
    if (use->is_used() && use->uv_set < 2) sets[use->uv_set] = use->uv_set;
  }
  for (TextureUse* use : texture_uses(material)) {
    if (!use->is_used()) continue;
    auto place = std::find(sets.begin(), sets.end(), use->uv_set);
    if (place == sets.end() && sets[1] == kNone) place = sets.begin() + 1;
    if (place == sets.end() && sets[0] == kNone) place = sets.begin();
    if (place == sets.end()) {
      return fail(Code::kUnimplemented, "its textures use TEXCOORD_" + std::to_string(use->uv_set) +
                                            " besides two other sets of coordinates; at most two are supported");
    }
    *place = use->uv_set;
    use->uv_set = static_cast<std::uint32_t>(place - sets.begin());
  }
  return sets;
}

Material default_material() {
  Material material;
  material.name = "default";
  material.base_color = Spectrum(1);
  material.metallic = 1;
  material.specular = 1;
  return material;
}

}  // namespace

Result<std::vector<GltfUvSets>> read_gltf_materials(const GltfModel& model, Scene& scene) {
  GltfTextureReader textures(model, scene);
  std::vector<GltfUvSets> uv_sets;
  for (const json& source : model.materials) {
    const std::string pointer = "/materials/" + std::to_string(uv_sets.size());
    Result<Material> material = read_material(source, textures, scene);
    if (!material) return annotate(material.error(), pointer);
    const auto sets = assign_uv_sets(*material);
    if (!sets) return annotate(sets.error(), pointer);
    uv_sets.push_back(*sets);
    scene.materials.push_back(std::move(*material));
  }
  scene.materials.push_back(default_material());
  uv_sets.push_back({kNone, kNone});
  return uv_sets;
}

}  // namespace radfarm
