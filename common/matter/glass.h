#pragma once

#include "matter/albedo_table.h"

namespace radfarm {

/// What rough clear glass does with light from one direction by one facet: lossless but for what meets a second one.
struct GlassAlbedo {
  float reflected = 0;
  float transmitted = 0;
  float lost() const { return std::max(0.0F, 1 - reflected - transmitted); }
};
inline GlassAlbedo blend(const GlassAlbedo& a, const GlassAlbedo& b, float share) {
  return {blend(a.reflected, b.reflected, share), blend(a.transmitted, b.transmitted, share)};
}
inline void add_weighted(GlassAlbedo& sum, const GlassAlbedo& value, float weight) {
  sum.reflected += value.reflected * weight;
  sum.transmitted += value.transmitted * weight;
}

/// A rough interface between two dielectrics, seen from one side: its exact Fresnel albedos on either side, and how light that
/// goes on between facets leaves them, evenly on both sides:                                                   (matter.5)
///   same side:  f(o, i) = stays       lost(o) lost(i) / (pi mean lost)
///   other side: f(o, i) = (1 - stays) lost(o) lost'(i) / (pi mean lost')      (': of the other side)
/// which adds up to what is lost, and is reciprocal by the choice of `stays`.
struct RoughGlass {
  AlbedoTable<GlassAlbedo>::Curve near;
  AlbedoTable<GlassAlbedo>::Curve far;
  float stays = 0.5F;
};

/// `roughness` not a mirror's. The tables of an index are made on its first use (0.3 s) and kept; indices less than 0.8 % apart
/// share them. Thread-safe.
RoughGlass rough_glass(float ior, float roughness, bool is_front);

}  // namespace radfarm
