#pragma once

#include "math/spectrum.h"

namespace radfarm {

/// The material of one surface point, textures looked up: what a Bsdf is made of. The layers are those of glTF
/// (docs/materials.md): sheen and a clear coat over a dielectric layer over a base that is diffuse, metal or transmits.
struct Matter {
  Spectrum base{0.5F};              // [0, 1]
  float metallic = 0;               // share of the base that is metal
  float roughness = 1;              // GGX alpha = roughness^2
  float specular = 0;               // weight of the dielectric layer
  Spectrum specular_color{1.0F};    // of the layer at normal incidence
  float ior = 1.5F;
  float transmission = 0;           // share of the base that passes light
  bool has_volume = false;          // passes it into a volume, bent; otherwise through a thin pane
  float clearcoat = 0;
  float clearcoat_roughness = 0;
  Spectrum sheen;
  float sheen_roughness = 0;
  float anisotropy = 0;             // rougher across the tangent
  float anisotropy_rotation = 0;    // radians, of the tangent about the normal
  bool folds_specular = true;       // reflectance() counts what specular lobes send as diffuse; not: it is carried apart

  bool is_lambertian() const {
    return metallic == 0 && specular == 0 && transmission == 0 && clearcoat == 0 && is_black(sheen);
  }
  /// Passes light straight on: rays go through it (RayCaster) and the Bsdf has what it reflects.
  bool is_pane() const;
};

/// Rougher than this, a surface is treated by its microfacets, below as a mirror: no float density is that narrow.
inline constexpr float kLeastAlpha = 1e-3F;

inline bool Matter::is_pane() const {
  return transmission * (1 - metallic) > 0 && !has_volume && roughness * roughness < kLeastAlpha;
}

}  // namespace radfarm
