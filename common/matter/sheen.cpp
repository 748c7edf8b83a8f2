#include "matter/sheen.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

constexpr float kLeastCosine = 1e-3F;  // below, the fitted Lambda falls behind 1 / cosine and the lobe grows without bound

/// Fit of the distribution's Lambda. [Estevez and Kulla 2017, table 1]
float fit(float x, float alpha) {
  const float t = (1 - alpha) * (1 - alpha);
  const auto mix = [t](float rough, float smooth) { return rough * (1 - t) + smooth * t; };
  const float a = mix(21.5473F, 25.3245F), b = mix(3.82987F, 3.32435F), c = mix(0.19823F, 0.16801F);
  const float d = mix(-1.97760F, -1.27393F), e = mix(-4.32054F, -4.85967F);
  return a / (1 + b * std::pow(x, c)) + d * x + e;
}

float lambda(float cosine, float alpha) {
  if (cosine < 0.5F) return std::exp(fit(cosine, alpha));
  return std::exp(2 * fit(0.5F, alpha) - fit(1 - cosine, alpha));
}

}  // namespace

float eval_sheen(float roughness, const Vec3& o, const Vec3& i) {
  if (!(o.z > 0) || !(i.z > 0)) return 0;
  const float o_z = std::max(o.z, kLeastCosine), i_z = std::max(i.z, kLeastCosine);
  const float least = std::max(roughness, 0.07F);
  const float alpha = least * least;
  const Vec3 h = normalize(o + i);
  const float sine = std::sqrt(std::max(0.0F, 1 - h.z * h.z));
  const float distribution = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * kPi);
  return distribution / ((1 + lambda(o_z, alpha) + lambda(i_z, alpha)) * 4 * o_z * i_z);
}

}  // namespace radfarm
