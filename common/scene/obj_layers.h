#pragma once

#include "math/spectrum.h"
#include "scene/scene.h"

namespace radfarm {

/// The optics of an MTL material, checked: reflectances finite and not negative, Kd at most 1.
struct ObjOptics {
  SpectrumD diffuse;      // Kd
  SpectrumD specular;     // Ks
  SpectrumD filter{1.0};  // Tf: what passes; all where the file does not say
  double shininess = 1;   // Ns
  double ior = 1;         // Ni
  int illumination = 2;   // illum: 2 where the file does not say, so that Ks counts
};

/// Gives the material the lobes that `illum` asks for:
///   0, 1        Lambertian, rho = Kd
///   2, 8, 10    Kd below a layer that reflects Ks at normal incidence: ior is Ni where Ni alone reflects at least Ks
///               and at most twice that, else the one that reflects the largest channel of Ks; GGX alpha is
///               sqrt(2 / (Ns + 2)).
///               Kd + Ks above 1 is scaled as a whole. Without Ks exactly Lambertian.
///   3, 5        the same with roughness 0; where Kd is black, a mirror of metal with reflectance Ks
///   4, 6, 7, 9  clear glass of colour Tf and ior Ni: a solid body for 6 and 7 (refraction) if Ni is not 1, else thin
void set_obj_layers(const ObjOptics& optics, Material& material);

/// Whether `illum` asks for glass, whose transparency is not coverage.
bool is_obj_glass(int illumination);

}  // namespace radfarm
