#pragma once

#include "scene/camera.h"
#include "scene/world.h"

namespace radfarm {

/// By how much the detail that a camera sees raises the threshold of what is visible, mean over the image, 1 to `most`: that
/// of the reflectances alone, evenly lit, by one filtered ray a block of pixels (masking.4). 1 where nothing reflects. Cost:
/// at most 102400 rays.
double detail_elevation(const World& world, const Camera& camera, int width, int height, float most);

}  // namespace radfarm
