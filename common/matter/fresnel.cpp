#include "matter/fresnel.h"

#include <cmath>

namespace radfarm {
namespace {

struct Polarised {
  float s = 1;
  float p = 1;
};

Polarised reflectances(float cosine, float eta) {
  cosine = std::clamp(cosine, 0.0F, 1.0F);
  const float sine_squared = (1 - cosine * cosine) / (eta * eta);
  if (!(sine_squared < 1)) return {};
  const float inside = std::sqrt(1 - sine_squared);
  const float s = (cosine - eta * inside) / (cosine + eta * inside);
  const float p = (eta * cosine - inside) / (eta * cosine + inside);
  return {s * s, p * p};
}

}  // namespace

float fresnel_dielectric(float cosine, float eta) {
  if (eta == 1) return 0;
  const Polarised r = reflectances(cosine, eta);
  return (r.s + r.p) / 2;
}

float pane_transmittance(float cosine, float ior) {
  if (ior == 1) return 1;
  const Polarised r = reflectances(cosine, ior);
  return ((1 - r.s) / (1 + r.s) + (1 - r.p) / (1 + r.p)) / 2;
}

}  // namespace radfarm
