#pragma once

#include "image/visibility_threshold.h"
#include "senders/receivers.h"

namespace radfarm {

/// A small image of what will be rendered, made of what the prepass saw: L_e + rho E / pi, cd/m^2 (masking.4). Textures and
/// outlines are the points' own, E is that of the radiosity solution, interpolated on the grid by the side that a surface
/// faces, so that patches do not show. The sky stands behind. Gloss and mirrors show their diffuse part only.
struct PilotImage {
  LuminanceImage radiance;
  int block = 1;  // pixels of the film along each side of one of the pilot's

  std::size_t pixel_of(std::uint32_t film_pixel, int film_width) const;
};
PilotImage make_pilot_image(const World& world, const Prepass& film, const PerspectiveGrid& grid, const VisiblePoints& seen);

}  // namespace radfarm
