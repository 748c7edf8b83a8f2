#pragma once

#include <string>
#include <vector>

#include "base/status.h"
#include "estimate/aov.h"
#include "image/color_map.h"
#include "image/image.h"

namespace radfarm {

/// The AOVs that an image has all channels of.
AovSet aovs_of(const Image& image);

/// An AOV for looking at.
struct AovPicture {
  std::vector<Rgba8> pixels;  // row by row
  std::string legend;         // what the colours mean, such as "0.5 to 8.1 m, violet to yellow"
};

/// Albedo as it is; normals as (n + 1) / 2; cells of the grid each in a colour of its own; the classes blended from four colours;
/// all else from violet to yellow between its 1st and its 99th percentile (color_map.h). Requires: aovs_of(image) has it.
AovPicture draw_aov(const Image& image, Aov aov);

}  // namespace radfarm
