#pragma once

#include "senders/pilot_image.h"
#include "senders/settings.h"

namespace radfarm {

/// What may be wrong by how much where: the largest accepted change of radiance at each grid vertex, and how it came about.
struct VertexThresholds {
  std::vector<float> values;    // one a vertex, cd/m^2
  LuminanceImage elevation;     // of the threshold by detail, over the film, one value a block of pixels
  float exposure_ev = 0;        // stops that make the pilot image's logarithmic mean middle grey
  double mean_plain = 0;        // cd/m^2, over visible points: without detail
  double mean = 0;              // with it
};

/// Just visible differences of the displayed image, times settings.threshold_scale, in scene units: T = TVI(L_a) elevation /
/// k, where k L is what the display shows (masking.5). A vertex has the mean over the visible points in the cells around it
/// (ALGORITHMS A9), one without points the mean of all. Where the pilot image is black, settings.threshold everywhere.
VertexThresholds visible_thresholds(const World& world, const Prepass& film, const PerspectiveGrid& grid,
                                    const VisiblePoints& seen, const SenderSettings& settings);

/// The same everywhere.
VertexThresholds even_thresholds(const PerspectiveGrid& grid, float threshold);

}  // namespace radfarm
