#pragma once

#include <string>
#include <vector>

#include "math/sampling.h"
#include "matter/bsdf.h"

namespace radfarm::test {

/// Matter that the tests of scattering share. All of it white: what is missing from 1 is lost.

inline Matter white_metal(float roughness) {
  Matter m;
  m.base = Spectrum(1.0F), m.metallic = 1, m.specular = 1, m.roughness = roughness;
  return m;
}
inline Matter white_dielectric(float roughness) {
  Matter m = white_metal(roughness);
  m.metallic = 0;
  return m;
}
inline Matter anisotropic(float roughness, float anisotropy, float rotation = 0.7F) {
  Matter m = white_metal(roughness);
  m.anisotropy = anisotropy, m.anisotropy_rotation = rotation;
  return m;
}
inline Matter coated(Matter m, float roughness) {
  m.clearcoat = 1, m.clearcoat_roughness = roughness;
  return m;
}
inline Matter with_sheen(Matter m, float roughness) {
  m.sheen = Spectrum(1.0F), m.sheen_roughness = roughness;
  return m;
}
inline Matter thin_glass(float roughness) {
  Matter m = white_dielectric(roughness);
  m.transmission = 1;
  return m;
}
inline Matter solid_glass(float roughness, float ior = 1.5F) {
  Matter m = thin_glass(roughness);
  m.has_volume = true, m.ior = ior;
  return m;
}

/// A Bsdf whose normal is z and whose tangent is x.
inline Bsdf bsdf_of(const Matter& m, const Vec3& to_viewer, bool is_front = true) {
  return Bsdf(m, Frame(Vec3(0, 0, 1)), to_viewer, is_front);
}
inline Vec3 towards(float cosine, float turn = 0.3F) {
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

/// What matter scatters of even light from everywhere, by its samplers, as the renderer adds it up.
struct Albedo {
  SpectrumD diffuse, specular_above, specular_below;
  SpectrumD above() const { return diffuse + specular_above; }
  SpectrumD all() const { return above() + specular_below; }
};
inline Albedo sampled_albedo(const Bsdf& bsdf, int samples = 1 << 14) {
  Albedo albedo;
  for (int s = 0; s < samples; ++s) {
    // Even in three dimensions: the choice of a lobe and the direction in it. [Roberts 2018, R3]
    const auto part = [s](double step) { return static_cast<float>(std::fmod(0.5 + s * step, 1.0)) * 0x1.fffffep-1F; };
    const Vec2 u(part(0.8191725133961645), part(0.6710436067037893));
    const Vec3 even = sample_cosine_hemisphere(u);
    albedo.diffuse += SpectrumD(bsdf.diffuse_reflectance() * bsdf.diffuse_shape(even));
    const Bsdf::Sample sample = bsdf.sample_specular(part(0.5497004779019703), u);
    (sample.direction.z > 0 ? albedo.specular_above : albedo.specular_below) += SpectrumD(sample.weight);
  }
  const double share = 1.0 / samples;
  albedo.diffuse *= share, albedo.specular_above *= share, albedo.specular_below *= share;
  return albedo;
}

}  // namespace radfarm::test
