#pragma once

#include <cstdint>

#include "scene/world.h"

namespace radfarm {

/// Of the light that diffuse surfaces reflect, the share that came straight from specular lobes, and what a few thousand
/// light paths leave open of it.
struct SpecularShare {
  double share = 0;
  double at_most = 0;  // upper end of a one-sided 95 % interval
};

/// Shares by what sends the light: materials whose lobes are sharp (is_sharp()), and all others.
struct SpecularShares {
  SpecularShare sharp;
  SpecularShare rough;
};

/// Whether a material has a specular lobe that is narrower than what radiosity may take for diffuse: mirrors, glass,
/// polish, varnish. Textures count with their mean.
bool is_sharp(const Scene& scene, const Material& material);

/// Follows 16384 light paths. Requires: emitters.size() > 0. About .1 s of one thread; uses all.
SpecularShares measure_specular_shares(const World& world, std::uint64_t seed);

}  // namespace radfarm
