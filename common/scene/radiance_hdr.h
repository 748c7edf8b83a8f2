#pragma once

#include <string_view>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Pixels of a picture, row 0 at the top.
struct HdrImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Spectrum> pixels;
};

/// Decodes a Radiance picture (.hdr, .pic): RGBE, flat or run-length encoded in the old or the new way, rows and
/// columns running either way (+-Y M +-X N). The values are the file's divided by its EXPOSURE lines. Sizes are checked
/// before memory is taken. INVALID_ARGUMENT when it is no such file or is cut off, UNIMPLEMENTED for XYZE,
/// RESOURCE_EXHAUSTED above the limits.
Result<HdrImage> decode_radiance_hdr(std::string_view bytes);

}  // namespace radfarm
