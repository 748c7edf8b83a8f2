#include "effects/specialise.h"

#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "effects/texture_range.h"
#include "scene/photometry.h"
#include "scene/scene_file.h"
#include "scene/texture_uses.h"
#include "scene/validate.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kTextures = 11;  // one for each use of a material

/// A scene that calls for every effect: material 0 is a body with all layers and textures, 1 a pane with holes.
Scene scene_with_everything() {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F), Spectrum(3.0F)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  maker.polygon(maker.material(Spectrum(0.8F)), {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  Scene scene = maker.take();
  for (Mesh& mesh : scene.meshes) mesh.uv[0] = {{0, 0}, {1, 0}, {0, 1}};
  Texture texture{2, 1, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {{0, 51, 102, 255}, {255, 153, 102, 0}}};
  scene.textures.assign(kTextures, texture);
  Material& m = scene.materials[0];
  std::uint32_t next = 0;
  for (TextureUse* use : texture_uses(m)) use->texture = next++;
  m.metallic = m.specular = m.clearcoat = m.anisotropy = m.transmission = 0.5F;
  m.sheen_color = Spectrum(0.5F);
  m.has_volume = true;
  m.alpha_mode = Material::Alpha::kMask;
  scene.materials[1].transmission = 0.25F;
  scene.materials[1].alpha_mode = Material::Alpha::kBlend;
  scene.materials[1].alpha = 0.5F;
  scene.lights.resize(2);
  scene.lights[0].intensity = Spectrum(2.0F);
  scene.lights[1].intensity = Spectrum(3.0F);
  scene.lights[1].photometry = 0;
  scene.lights[1].kind = PunctualLight::Kind::kSpot;
  scene.photometries.push_back({"lamp", {0, 90, 180}, {0}, {100, 50, 0}});
  scene.environment = {2, 1, {Spectrum(1.0F), Spectrum(2.0F)}, {}};
  return scene;
}

struct Case {
  Effect effect;
  std::function<bool(const Scene&)> calls_for;
};

std::vector<Case> cases() {
  const auto any = [](auto member) {
    return [member](const Scene& s) { return s.materials[0].*member > 0 || s.materials[1].*member > 0; };
  };
  return {{Effect::kAreaLights, [](const Scene& s) { return !is_black(s.materials[0].emission); }},
          {Effect::kPunctualLights, [](const Scene& s) { return !s.lights.empty(); }},
          {Effect::kIes, [](const Scene& s) { return s.lights.size() > 1 && s.lights[1].photometry != kNone; }},
          {Effect::kEnvironment, [](const Scene& s) { return !s.environment.is_empty(); }},
          {Effect::kGloss, [](const Scene& s) { return s.materials[0].metallic > 0 || s.materials[0].specular > 0; }},
          {Effect::kClearcoat, any(&Material::clearcoat)},
          {Effect::kSheen, [](const Scene& s) { return !is_black(s.materials[0].sheen_color); }},
          {Effect::kAnisotropy, any(&Material::anisotropy)},
          {Effect::kTransmission, [](const Scene& s) { return s.materials[0].transmission > 0; }},
          {Effect::kPanes, [](const Scene& s) { return s.materials[1].transmission > 0; }},
          {Effect::kAlphaCutouts,
           [](const Scene& s) {
             return s.materials[0].alpha_mode != Material::Alpha::kOpaque ||
                    s.materials[1].alpha_mode != Material::Alpha::kOpaque || s.materials[1].alpha < 1;
           }},
          {Effect::kReflectanceTextures,
           [](const Scene& s) {
             const TextureUse& use = s.materials[0].base_texture;
             return use.is_used() && max_component(range_of(s.textures[use.texture]).deviation) > 0;
           }},
          {Effect::kEmissionTextures, [](const Scene& s) { return s.materials[0].emission_texture.is_used(); }},
          {Effect::kNormalMaps, [](const Scene& s) { return s.materials[0].normal_texture.is_used(); }}};
}

TEST(Specialise, TakesOutWhatOneEffectNeedsAndLeavesTheOthers) {
  const std::vector<Case> all = cases();
  for (const Case& off : all) {
    const Scene scene = specialise(scene_with_everything(), bit_of(off.effect));
    for (const Case& other : all) {
      const bool expected =
          other.effect != off.effect && !(off.effect == Effect::kPunctualLights && other.effect == Effect::kIes);
      EXPECT_EQ(other.calls_for(scene), expected) << id_of(other.effect) << " without " << id_of(off.effect);
    }
    EXPECT_TRUE(validate(scene)) << id_of(off.effect);
  }
}

TEST(Specialise, TouchesNothingWhereNothingIsOff) {
  const std::vector<std::byte> before = encode_scene(scene_with_everything());
  const EffectSet none = 0, outside = bit_of(Effect::kInterreflection) | bit_of(Effect::kDepthOfField);
  EXPECT_FALSE(changes_scene(none));
  EXPECT_FALSE(changes_scene(outside));
  EXPECT_EQ(encode_scene(specialise(scene_with_everything(), none)), before);
  EXPECT_EQ(encode_scene(specialise(scene_with_everything(), outside)), before);
}

TEST(Specialise, EmptiesTexturesThatNothingUsesAnyMore) {
  const Scene scene = specialise(scene_with_everything(), bit_of(Effect::kNormalMaps));
  const std::uint32_t normals = scene_with_everything().materials[0].normal_texture.texture;
  for (std::uint32_t i = 0; i < kTextures; ++i) {
    EXPECT_EQ(scene.textures[i].texels.size(), i == normals ? 1U : 2U) << i;
  }
}

TEST(Specialise, ATextureThatAnotherMaterialUsesStays) {
  Scene shared = scene_with_everything();
  shared.materials[1].base_texture = shared.materials[0].normal_texture;
  const std::uint32_t normals = shared.materials[0].normal_texture.texture;
  EXPECT_EQ(specialise(shared, bit_of(Effect::kNormalMaps)).textures[normals].texels.size(), 2U);
}

TEST(Specialise, ReflectanceBecomesTheMeanAndHolesStay) {
  Scene scene = specialise(scene_with_everything(), bit_of(Effect::kReflectanceTextures));
  // Means of 0 and 1, 0.2 and 0.6, 0.4 and 0.4, times 0.5.
  EXPECT_NEAR(scene.materials[0].base_color.r, 0.25F, 1e-6F);
  EXPECT_NEAR(scene.materials[0].base_color.g, 0.2F, 1e-6F);
  EXPECT_NEAR(scene.materials[0].base_color.b, 0.2F, 1e-6F);
  const Texture& holes = scene.textures.at(scene.materials[0].base_texture.texture);
  EXPECT_EQ(holes.texels[0], (std::array<std::uint8_t, 4>{255, 255, 255, 255}));
  EXPECT_EQ(holes.texels[1], (std::array<std::uint8_t, 4>{255, 255, 255, 0}));
  Scene opaque = scene_with_everything();
  opaque.materials[0].alpha_mode = Material::Alpha::kOpaque;
  EXPECT_FALSE(specialise(opaque, bit_of(Effect::kReflectanceTextures)).materials[0].base_texture.is_used());
}

TEST(Specialise, EmissionBecomesTheMean) {
  const Scene scene = specialise(scene_with_everything(), bit_of(Effect::kEmissionTextures));
  EXPECT_NEAR(scene.materials[0].emission.r, 1.5F, 1e-5F);
  EXPECT_NEAR(scene.materials[0].emission.g, 1.2F, 1e-5F);
}

TEST(Specialise, AnIesLightBecomesAPointOfTheSameFlux) {
  const Scene scene = specialise(scene_with_everything(), bit_of(Effect::kIes));
  const double flux = 3 * zonal_lumens(scene_with_everything().photometries[0]);
  EXPECT_EQ(scene.lights[1].kind, PunctualLight::Kind::kPoint);
  EXPECT_NEAR(static_cast<double>(scene.lights[1].intensity.g) * 4 * static_cast<double>(kPi), flux, 1e-5 * flux);
  EXPECT_EQ(scene.lights[0].intensity, Spectrum(2.0F));
}

TEST(Specialise, FoldsTheGlossOfTheEffectsThatAreOff) {
  Scene scene = scene_with_everything();
  scene.materials.resize(3);
  scene.materials[0] = {}, scene.materials[1] = {}, scene.materials[2] = {};
  scene.materials[0].metallic = 1, scene.materials[0].roughness = 0.1F;
  scene.materials[1].specular = 1, scene.materials[1].roughness = 0.8F;
  scene.materials[2].specular = 1, scene.materials[2].clearcoat = 1;
  const auto folded = [&](EffectSet off) {
    const Scene made = specialise(scene, off);
    return std::array{made.materials[0].folds_specular, made.materials[1].folds_specular, made.materials[2].folds_specular};
  };
  EXPECT_EQ(folded(0), (std::array{false, false, false}));
  EXPECT_EQ(folded(bit_of(Effect::kCaustics)), (std::array{true, false, true}));
  EXPECT_EQ(folded(bit_of(Effect::kGlossyInterreflection)), (std::array{false, true, false}));
}

TEST(Effects, IdsAndEffectsAreEachOthersInverse) {
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Effect::kCount); ++i) {
    EXPECT_EQ(effect_of(id_of(Effect{i})), Effect{i});
  }
  EXPECT_EQ(effect_of("subsurface"), Effect::kCount);
  EXPECT_EQ(effect_of(""), Effect::kCount);
}

}  // namespace
}  // namespace radfarm
