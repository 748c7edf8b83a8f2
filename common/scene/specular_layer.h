#pragma once

#include "math/spectrum.h"
#include "scene/scene.h"

namespace radfarm {

/// F0 = ((n - 1) / (n + 1))^2: what a dielectric of index of refraction n reflects at normal incidence.
double reflectance_of_ior(double ior);

/// Its inverse, n = (1 + sqrt F0) / (1 - sqrt F0). F0 above 0.99 counts as 0.99, n = 398: no n reflects everything.
double ior_of_reflectance(double reflectance);

/// Gives the material a full dielectric layer that reflects `reflectance` at normal incidence: with `least_ior` where
/// that reflects enough, else with the ior that does; specular_color is the rest, so never above 1. Black: no layer.
void set_specular_layer(const SpectrumD& reflectance, double least_ior, Material& material);

}  // namespace radfarm
