#pragma once

#include "estimate/aov.h"
#include "frame/assemble.h"

namespace radfarm {

/// Adds the layers of `set` to an image of the raster's size; docs/formats.md lists their channels, units and what they are where
/// nothing is seen. A pixel without any kept sample is NaN. Requires: raster.aovs, one a pixel.
void add_aov_layers(AovSet set, const Raster& raster, Image& image);

}  // namespace radfarm
