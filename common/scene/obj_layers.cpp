#include "scene/obj_layers.h"

#include <algorithm>
#include <cmath>

#include "scene/specular_layer.h"

namespace radfarm {
namespace {

Spectrum at_most_one(const SpectrumD& reflectance) {
  return Spectrum(reflectance / std::max(1.0, max_component(reflectance)));
}

void set_glass(const ObjOptics& optics, Material& material) {
  material.base_color = at_most_one(optics.filter);
  material.roughness = 0;
  material.specular = 1;
  material.ior = static_cast<float>(std::clamp(optics.ior, 1.0, ior_of_reflectance(1)));
  material.transmission = 1;
  const bool is_refracted = optics.illumination == 6 || optics.illumination == 7;
  material.has_volume = is_refracted && material.ior != 1;
}

void set_mirror(const ObjOptics& optics, Material& material) {
  material.base_color = at_most_one(optics.specular);
  material.metallic = 1;
  material.roughness = 0;
}

/// GGX's width for the Blinn-Phong exponent Ns [Walter et al. 2007, section 5.2], as the roughness whose square it is.
float roughness_of(double shininess) {
  const double alpha = std::sqrt(2 / (std::max(shininess, 0.0) + 2));
  return static_cast<float>(std::sqrt(alpha));
}

}  // namespace

bool is_obj_glass(int illumination) {
  return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}

void set_obj_layers(const ObjOptics& optics, Material& material) {
  const bool is_mirror = optics.illumination == 3 || optics.illumination == 5;
  material.base_color = Spectrum(optics.diffuse);
  if (is_obj_glass(optics.illumination)) return set_glass(optics, material);
  if (optics.illumination < 2 || is_black(optics.specular)) return;
  if (is_mirror && is_black(optics.diffuse)) return set_mirror(optics, material);
  const double scale = 1 / std::max(1.0, max_component(optics.diffuse + optics.specular));
  material.base_color = Spectrum(optics.diffuse * scale);
  const SpectrumD specular = optics.specular * scale;
  const double of_ior = optics.ior > 1 ? reflectance_of_ior(optics.ior) : 0;
  const bool agrees = max_component(specular) <= of_ior && 2 * max_component(specular) >= of_ior;
  set_specular_layer(specular, agrees ? optics.ior : 1, material);
  material.roughness = is_mirror ? 0.0F : roughness_of(optics.shininess);
}

}  // namespace radfarm
