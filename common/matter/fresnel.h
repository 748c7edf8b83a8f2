#pragma once

#include "math/spectrum.h"

namespace radfarm {

/// Share of unpolarised light that an interface between dielectrics reflects. `cosine` in [0, 1] on the incident side, `eta` the
/// index of the other side over that of the incident one. 1 beyond the critical angle. Exact. [Fresnel]
float fresnel_dielectric(float cosine, float eta);

/// What a lossless pane of parallel faces passes, all reflections between the faces added up, no phases:
/// T = 1/2 sum (1 - R) / (1 + R) over both polarisations.                              docs/materials.md (matter.3), oracle O17
float pane_transmittance(float cosine, float ior);

/// Reflectance at normal incidence between air and `ior`.
inline float normal_reflectance(float ior) {
  const float ratio = (ior - 1) / (ior + 1);
  return ratio * ratio;
}

/// (1 - cosine)^5, the shape of Schlick's approximation F = F0 + (F90 - F0) (1 - cosine)^5.
inline float schlick_weight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0F, 1.0F);
  const float squared = m * m;
  return squared * squared * m;
}

}  // namespace radfarm
