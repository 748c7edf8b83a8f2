#include "effects/specialise.h"

#include <array>
#include <utility>
#include <vector>

#include "effects/specular_share.h"
#include "effects/texture_range.h"
#include "scene/photometry.h"
#include "scene/texture_uses.h"

namespace radfarm {
namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(Effect::kCount)> kIds = {
    "area_lights",    "punctual_lights",      "ies",               "environment", "interreflection", "gloss",
    "clearcoat",      "sheen",                "anisotropy",        "transmission", "panes",          "alpha_cutouts",
    "reflectance_textures", "emission_textures", "normal_maps",    "depth_of_field", "caustics", "glossy_interreflection", "masking"};

/// A base texture whose alpha still cuts holes keeps it; its colour becomes even.
void even_out(Scene& scene, Material& m) {
  if (!m.base_texture.is_used()) return;
  m.base_color = m.base_color * range_of(scene.textures[m.base_texture.texture]).mean;
  if (m.alpha_mode == Material::Alpha::kOpaque) {
    m.base_texture = {};
    return;
  }
  Texture white = scene.textures[m.base_texture.texture];
  for (auto& texel : white.texels) texel[0] = texel[1] = texel[2] = 255;
  m.base_texture.texture = static_cast<std::uint32_t>(scene.textures.size());
  scene.textures.push_back(std::move(white));
}

void strip_layers(Material& m, EffectSet off) {
  if (contains(off, Effect::kGloss)) m.metallic = m.specular = 0;
  if (contains(off, Effect::kClearcoat)) m.clearcoat = 0;
  if (contains(off, Effect::kSheen)) m.sheen_color = {};
  if (contains(off, Effect::kAnisotropy)) m.anisotropy = 0;
  if (contains(off, m.has_volume ? Effect::kTransmission : Effect::kPanes)) m.transmission = 0;
  if (contains(off, Effect::kNormalMaps)) m.normal_texture = {};
  if (contains(off, Effect::kAreaLights)) m.emission = {};
}

void strip_textures(Scene& scene, Material& m, EffectSet off) {
  if (contains(off, Effect::kAlphaCutouts)) m.alpha_mode = Material::Alpha::kOpaque, m.alpha = 1;
  if (contains(off, Effect::kReflectanceTextures)) even_out(scene, m);
  if (contains(off, Effect::kEmissionTextures) && m.emission_texture.is_used()) {
    m.emission = m.emission * range_of(scene.textures[m.emission_texture.texture]).mean;
    m.emission_texture = {};
  }
}

void strip_lights(Scene& scene, EffectSet off) {
  if (contains(off, Effect::kPunctualLights)) scene.lights.clear();
  if (contains(off, Effect::kEnvironment)) scene.environment = {};
  if (!contains(off, Effect::kIes)) return;
  for (PunctualLight& light : scene.lights) {
    if (light.photometry == kNone) continue;
    const double mean = zonal_lumens(scene.photometries[light.photometry]) / (4 * static_cast<double>(kPi));
    light.intensity *= static_cast<float>(mean);
    light.photometry = kNone;
    light.kind = PunctualLight::Kind::kPoint;
  }
}

void empty_unused_textures(Scene& scene) {
  std::vector<bool> is_used(scene.textures.size());
  for (const Material& m : scene.materials) {
    for (const TextureUse* use : texture_uses(m)) {
      if (use->is_used()) is_used[use->texture] = true;
    }
  }
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    if (!is_used[i]) scene.textures[i] = {1, 1, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {{255, 255, 255, 255}}};
  }
}

}  // namespace

Effect effect_of(std::string_view id) {
  std::uint32_t i = 0;
  while (i < kIds.size() && kIds[i] != id) ++i;
  return static_cast<Effect>(i);
}

std::string_view id_of(Effect effect) { return kIds[static_cast<std::size_t>(effect)]; }

Scene specialise(Scene scene, EffectSet off) {
  for (Material& material : scene.materials) {
    material.folds_specular = contains(off, is_sharp(scene, material) ? Effect::kCaustics : Effect::kGlossyInterreflection);
  }
  if (!changes_scene(off)) return scene;
  for (Material& material : scene.materials) {
    strip_layers(material, off);
    strip_textures(scene, material, off);
  }
  strip_lights(scene, off);
  empty_unused_textures(scene);
  return scene;
}

}  // namespace radfarm
