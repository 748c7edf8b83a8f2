#include "scene/specular_layer.h"

#include <algorithm>
#include <cmath>

namespace radfarm {

double reflectance_of_ior(double ior) {
  const double root = (ior - 1) / (ior + 1);
  return root * root;
}

double ior_of_reflectance(double reflectance) {
  const double root = std::sqrt(std::clamp(reflectance, 0.0, 0.99));
  return (1 + root) / (1 - root);
}

void set_specular_layer(const SpectrumD& reflectance, double least_ior, Material& material) {
  const double largest = max_component(reflectance);
  material.specular = largest > 0 ? 1.0F : 0.0F;
  if (!(largest > 0)) return;
  const double of_least = reflectance_of_ior(least_ior);
  material.ior = static_cast<float>(largest <= of_least ? least_ior : ior_of_reflectance(largest));
  material.specular_color = Spectrum(reflectance / std::max(largest, of_least));
}

}  // namespace radfarm
