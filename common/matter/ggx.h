#pragma once

#include "math/vec.h"

namespace radfarm {

/// Microfacets with the GGX distribution of normals and Smith's height-correlated shadowing. All directions are local unit
/// vectors, z along the surface's normal. [Walter et al. 2007; Heitz 2014, 2018]
struct Ggx {
  float alpha_x = 0.5F;  // along the tangent
  float alpha_y = 0.5F;

  /// Density of facets with normal h, per steradian and projected area: its integral of D cos is 1.
  float distribution(const Vec3& h) const;
  /// Smith's Lambda: 1 / (1 + Lambda) of the facets that face `w` are seen from there.
  float lambda(const Vec3& w) const;
  /// Share of facets seen from w.
  float masking(const Vec3& w) const { return 1 / (1 + lambda(w)); }
  /// Share of facets seen from both sides.
  float masking(const Vec3& o, const Vec3& i) const { return 1 / (1 + lambda(o) + lambda(i)); }
  /// masking(o, i) / (4 o.z i.z), without its quotients of nothing at grazing.
  float visibility(const Vec3& o, const Vec3& i) const { return 0.5F / (stretch(o) * i.z + stretch(i) * o.z); }
  /// Length of w seen by the hemisphere that the facets become when the surface is stretched.
  float stretch(const Vec3& w) const;
  /// A facet's normal in proportion to the area of it seen from o, o.z > 0. [Heitz 2018]
  Vec3 sample_visible(const Vec3& o, const Vec2& u) const;
  /// The same by a point that is uniform in the unit disk.
  Vec3 visible_facet(const Vec3& o, const Vec2& disk) const;
  /// Density of sample_visible(), per steradian of h.
  float pdf_visible(const Vec3& o, const Vec3& h) const;
  /// Density of reflect(o, sample_visible()), per steradian of it: pdf_visible / (4 dot(o, h)), where nothing can cancel out.
  float pdf_reflected(const Vec3& o, const Vec3& h) const { return distribution(h) / (2 * (o.z + stretch(o))); }
};

/// Directions that light towards o comes from by a facet h, on its side and through it. `eta`: the far side's index over that of
/// o's; the zero vector beyond the critical angle.
Vec3 refract(const Vec3& o, const Vec3& h, float eta);
inline Vec3 reflect(const Vec3& o, const Vec3& h) { return h * (2 * dot(o, h)) - o; }

}  // namespace radfarm
