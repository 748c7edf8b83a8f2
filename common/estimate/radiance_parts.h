#pragma once

#include <cstdint>

#include "math/spectrum.h"

namespace radfarm {

/// One estimate of the radiance that reaches the camera (docs/pipeline.md, partition). The first diffuse surface on the way
/// back from the camera, by whatever mirrors, glass and gloss, is the receiver: light is classed by the last vertex before it.
struct RadianceParts {
  Spectrum emission;  // seen directly
  Spectrum direct;    // reaches the receiver from an emitter
  Spectrum indirect;  // ... from a diffuse surface
  Spectrum specular;  // ... from a specular one, and emission that the camera sees by specular surfaces

  Spectrum reflected() const { return direct + indirect + specular; }
  friend bool operator==(const RadianceParts&, const RadianceParts&) = default;
};

/// How far a path from the camera has come: which part the light belongs to that it finds next.
enum class PathStage : std::uint8_t { kSeen, kEyeChain, kReceiver, kIndirect, kSpecular };

/// The part of light emitted by what a path meets.
Spectrum& part_of_emission(RadianceParts& parts, PathStage stage);
/// The part of light that a vertex scatters along the path, by its diffuse or its specular lobes.
Spectrum& part_of_scattering(RadianceParts& parts, PathStage stage, bool is_specular);
/// Where the path is after it went on by a diffuse or a specular lobe.
PathStage stage_after(PathStage stage, bool is_specular);

}  // namespace radfarm
