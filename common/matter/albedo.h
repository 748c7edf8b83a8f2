#pragma once

#include <cstdint>
#include <vector>

#include "math/vec.h"
#include "matter/albedo_table.h"

namespace radfarm {

/// Directional albedos of the lobes: what a lobe reflects of the light from one direction, by tables made on first use (GGX 0.1 s, sheen
/// 0.3 s). Each is
/// a curve over the cosine at one roughness, to be held where many directions are asked for.

/// Of GGX microfacets with Schlick's Fresnel: F0 * at_0 + F90 * at_90, single scattering; both add up to the albedo of perfect
/// mirrors, so 1 minus their sum is what goes on between facets. [Karis 2013; Kulla and Conty 2017]
struct GgxAlbedo {
  float at_0 = 0;
  float at_90 = 0;
  float total() const { return at_0 + at_90; }
  float lost() const { return std::max(0.0F, 1 - total()); }
};
inline GgxAlbedo blend(const GgxAlbedo& a, const GgxAlbedo& b, float share) {
  return {blend(a.at_0, b.at_0, share), blend(a.at_90, b.at_90, share)};
}
inline void add_weighted(GgxAlbedo& sum, const GgxAlbedo& value, float weight) {
  sum.at_0 += value.at_0 * weight;
  sum.at_90 += value.at_90 * weight;
}

class GgxAlbedoCurve {
 public:
  /// Of mirrors.
  GgxAlbedoCurve() = default;
  explicit GgxAlbedoCurve(float roughness);
  /// `cosine` in [0, 1] to the normal.
  GgxAlbedo at(float cosine) const;
  /// The cosine-weighted mean over the hemisphere.
  GgxAlbedo mean() const { return curve_.low ? curve_.mean : GgxAlbedo{20.0F / 21, 1.0F / 21}; }

 private:
  AlbedoTable<GgxAlbedo>::Curve curve_;  // without rows: mirrors, by the formula
};

/// Of the sheen lobe with colour 1. As published it reflects more than it receives at grazing where it is smooth (up to 2.5 times at
/// a cosine of 0.01): `scale` is the factor, the same for both directions exchanged, that brings it to 1 at most.
class SheenCurve {
 public:
  SheenCurve() = default;
  explicit SheenCurve(float roughness);
  /// Of the scaled lobe.
  float at(float cosine) const { return albedo_.at(cosine); }
  float scale(float cosine_o, float cosine_i) const;

 private:
  AlbedoTable<float>::Curve albedo_;
  AlbedoTable<float>::Curve bare_;
};

/// Points of the unit disk that tables are integrated with.
std::vector<Vec2> disk_points(std::uint32_t count, std::uint64_t key);

/// For looking up one direction only.
inline GgxAlbedo ggx_albedo(float cosine, float roughness) { return GgxAlbedoCurve(roughness).at(cosine); }
inline GgxAlbedo ggx_mean_albedo(float roughness) { return GgxAlbedoCurve(roughness).mean(); }
inline float sheen_albedo(float cosine, float roughness) { return SheenCurve(roughness).at(cosine); }

}  // namespace radfarm
