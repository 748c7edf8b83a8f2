#pragma once

#include <algorithm>
#include <cmath>

namespace radfarm {

/// What one ray stands for beside itself, as a cone about it: a camera ray its share of the pixel, a scattered ray its share of the
/// directions. Textures are looked up over the cone's footprint. A cone of no width is a line: nothing is filtered.
///                                                      [Akenine-Moller et al. 2019, Ray Tracing Gems, chapter 20; Igehy 1999]
struct RayCone {
  float width = 0;   // m, where the ray starts
  float spread = 0;  // width gained each metre
  float share = 0;   // a scattered ray stands for this by root pdf, in each of two directions; 0: a line stays a line
};

inline RayCone advance(const RayCone& cone, float distance) { return {cone.width + cone.spread * distance, cone.spread, cone.share}; }

/// The cone of a ray that goes on from where `met` is the cone. A density of p per steradian leaves 1 / (n p) to each of n samples,
/// so gloss widens a cone a little, a diffuse surface much; mirrors and clear glass (delta) keep it, whatever their curvature.
/// [Suykens and Willems 2001, Path differentials and applications]
inline RayCone scatter(const RayCone& met, float pdf, bool is_delta) {
  constexpr float kWidest = 1;  // no wider than about a radian
  if (is_delta || met.share == 0) return met;
  return {met.width, std::max(met.spread, std::min(kWidest, met.share / std::sqrt(pdf))), met.share};
}

}  // namespace radfarm
