#pragma once

#include <cstdint>
#include <string_view>

#include "scene/scene.h"

namespace radfarm {

/// Effects that can be left out, one bit each: a scene is rendered without an effect by taking what calls for it out of the
/// scene (specialise) or by not running a stage. Bits are stored in settings: their order is fixed.
enum class Effect : std::uint32_t {
  kAreaLights,
  kPunctualLights,
  kIes,
  kEnvironment,
  kInterreflection,
  kGloss,
  kClearcoat,
  kSheen,
  kAnisotropy,
  kTransmission,
  kPanes,
  kAlphaCutouts,
  kReflectanceTextures,
  kEmissionTextures,
  kNormalMaps,
  kDepthOfField,
  kCaustics,               // off: what sharp lobes send to diffuse surfaces is as if they were diffuse ...
  kGlossyInterreflection,  // ... and what all other specular ones do
  kMasking,  // in no set: it steers thresholds, and changes nothing that is true of an image
  kCount
};
using EffectSet = std::uint32_t;

constexpr EffectSet bit_of(Effect effect) { return EffectSet{1} << static_cast<std::uint32_t>(effect); }
constexpr bool contains(EffectSet set, Effect effect) { return (set & bit_of(effect)) != 0; }
/// The effect with this id in the plan; kCount where there is none.
Effect effect_of(std::string_view id);
std::string_view id_of(Effect effect);

inline constexpr EffectSet kFoldable = bit_of(Effect::kCaustics) | bit_of(Effect::kGlossyInterreflection);

/// Whether leaving effects out takes anything out of the scene: interreflection and depth of field are no part of it, and of what
/// is folded only radiosity knows.
constexpr bool changes_scene(EffectSet off) {
  return (off & ~(bit_of(Effect::kInterreflection) | bit_of(Effect::kDepthOfField) | kFoldable)) != 0;
}
/// The scene without what calls for the effects in `off`; Material::folds_specular says of which materials gloss is folded into
/// diffuse. Textures that nothing uses any more are emptied.
Scene specialise(Scene scene, EffectSet off);

}  // namespace radfarm
