#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

/// An 8-bit sRGB PNG of 2^exposure_ev times R, G, B, clamped. Pixels that are NaN come out magenta, so nobody takes them for
/// black. INVALID_ARGUMENT without R, G, B.
Result<std::vector<std::byte>> encode_png(const Image& image, float exposure_ev);

/// An 8-bit RGBA PNG of pixels as they are, row 0 at the top. INVALID_ARGUMENT unless there are width x height of them.
Result<std::vector<std::byte>> encode_png(std::uint32_t width, std::uint32_t height,
                                          std::span<const std::array<std::uint8_t, 4>> pixels);

}  // namespace radfarm
