#pragma once

#include <cstdint>
#include <optional>

#include "scene/world.h"

namespace radfarm {

/// Light of an emitter that can neither be absorbed nor leave, so that no image of it exists.     docs/pipeline.md (radiosity.8)
struct TrappedLight {
  std::uint32_t emitter = 0;      // index into Emitters::triangles, then Emitters::punctual
  std::uint32_t channel = 0;      // 0 red, 1 green, 2 blue
  std::uint32_t reflections = 0;  // of a walk that lost less than one in all of them
};

/// The first emitter of which a channel is trapped: a walk from it, diffuse at every hit, sums up 1 - rho of what it meets in
/// that channel, or 1 where it meets nothing, and lost less than 1 in 65536 reflections. Only the part of the scene that the
/// emitter's light reaches counts, and each channel by itself. Directional lights and the sky come from outside, and leave again.
///
/// What is accepted would be amplified less than 65536 times. An opening that takes a smaller share of the light is not found.
/// Cost: about 1 us a reflection; a walk ends after 1 / (1 - rho) of them, and at an emitter whose light is known to get out.
/// Nothing where no material reflects everything.
std::optional<TrappedLight> find_trapped_light(const World& world, std::uint64_t seed);

}  // namespace radfarm
