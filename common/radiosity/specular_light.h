#pragma once

#include <vector>

#include "math/sampling.h"
#include "radiosity/first_light.h"
#include "radiosity/hierarchy.h"

namespace radfarm {

/// E_spec at undivided patches, lux, one a node: parts have that of their triangle's side. Empty where none is brought.
std::vector<Spectrum> specular_irradiance(const FirstLight& light, const SideNumbers& sides, const Hierarchy& hierarchy);

/// Light that specular paths bring, lm, where light paths start anew from it.                   docs/pipeline.md (radiosity.7)
struct SpecularArrival {
  SurfacePoint point;      // turned to the lit side
  Spectrum reflectance;    // there; 0 in so far as the surface is not there (coverage)
  Spectrum power;          // that arrives, divided by the probability of the choice: its mean is all that is brought
};

/// Chooses among the whole sides of a hierarchy by the luminance of the power that they receive, then a point evenly by area.
class SpecularStarts {
 public:
  SpecularStarts(const FirstLight& light, const SideNumbers& sides, const Hierarchy& hierarchy);
  /// All that is brought, lm (luminance).
  double flux() const { return choice_.total(); }
  /// Requires: flux() > 0.
  SpecularArrival sample(double choice, const Vec2& place) const;

 private:
  const World& world_;
  const Hierarchy& hierarchy_;
  std::vector<Spectrum> irradiance_;  // over Hierarchy::leaves; empty: none
  DiscreteDistribution choice_;       // over the same
};

}  // namespace radfarm
