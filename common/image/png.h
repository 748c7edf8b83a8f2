#pragma once

#include <cstddef>
#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

/// An 8-bit sRGB PNG of 2^exposure_ev times R, G, B, clamped. Pixels that are NaN come out magenta, so nobody takes them for
/// black. INVALID_ARGUMENT without R, G, B.
Result<std::vector<std::byte>> encode_png(const Image& image, float exposure_ev);

}  // namespace radfarm
