#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/status.h"
#include "meters/work_plane.h"

namespace radfarm {

/// Levels of contour lines between two illuminances: about eight, of 1, 2 or 5 times a power of ten apart. None where
/// they are equal.
std::vector<double> contour_levels(double least, double most);

/// A work plane's illuminance in false colours (viridis from the least to the most), dark lines at the levels; grey
/// where no meter is. As a PNG of about 800 pixels along its longer side, seen from above: x to the right, z down.
Result<std::vector<std::byte>> isolux_png(const WorkPlane& plane, std::span<const Reading> readings,
                                          std::span<const double> levels);

}  // namespace radfarm
