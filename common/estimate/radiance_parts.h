#pragma once

#include "math/spectrum.h"

namespace radfarm {

/// One estimate of the radiance that reaches the camera, by the class of its last vertex before the visible surface
/// (docs/pipeline.md, partition): emission seen directly, direct and indirect light reflected once towards the eye.
struct RadianceParts {
  Spectrum emission;
  Spectrum direct;
  Spectrum indirect;

  Spectrum reflected() const { return direct + indirect; }
  friend bool operator==(const RadianceParts&, const RadianceParts&) = default;
};

}  // namespace radfarm
