#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "base/status.h"
#include "image/image.h"
#include "math/spectrum.h"

namespace radfarm {

/// The three channels of one layer of an image, which must outlive it.
struct RgbLayer {
  std::span<const float> r, g, b;
  Spectrum at(std::size_t pixel) const { return {r[pixel], g[pixel], b[pixel]}; }
};

/// Layer "" is R, G, B; layer "direct" is direct.R, direct.G, direct.B. INVALID_ARGUMENT when one of them is missing.
Result<RgbLayer> rgb_layer(const Image& image, std::string_view layer = "");

/// INVALID_ARGUMENT unless the size is positive and every channel has one float a pixel.
Status validate(const Image& image);

}  // namespace radfarm
