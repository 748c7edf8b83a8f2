#pragma once

#include <span>
#include <vector>

#include "base/status.h"
#include "estimate/settings.h"
#include "estimate/photon_result.h"
#include "estimate/task_result.h"
#include "image/image.h"
#include "image/visibility_threshold.h"

namespace radfarm {

/// All pixels' sums in one raster, row by row.
struct Raster {
  std::vector<PixelSums> pixels;
  Counters counters;
  std::vector<AovSums> aovs = {};  // the same, or empty: nobody asked
  LuminanceImage elevation = {};   // of the visible threshold by detail, blocks of pixels each; empty without masking
  std::vector<SharingSums> sharing = {};  // the same, or empty: pixels do not share
  std::vector<PixelNeeds> needs = {};     // the same, or empty: all get the same number of samples
  std::vector<float> noise = {};          // variance, (cd/m^2)^2, of their mean reflected luminance; empty: not asked yet
};

/// Puts tiles together. DATA_LOSS when a pixel is missing or given twice, or its AOVs or what it shares are missing.
Result<Raster> assemble(const Settings& settings, std::span<const TileResult> tiles);

/// Adds what photon tasks brought, in their order; the pixel's variance becomes that of the batches. DATA_LOSS when a result is not of the image.
Status add_photons(std::span<const PhotonResult> results, Raster& raster);

/// The layers of DESIGN section 9: beauty at the root, emission, direct, indirect, specular (zero until photon paths), and the
/// AOVs that the settings name.
/// A pixel without any kept sample is an error of its job, found by dropped_share(), and NaN here: never a silent black.
Image to_image(const Settings& settings, const Raster& raster);

/// Samples left out because they were not finite or negative, as a share of all.
double dropped_share(const Raster& raster);

}  // namespace radfarm
