#pragma once

#include <cstddef>
#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm::cli {

/// R, G, B of an image at most `width` pixels wide, means over boxes; pixels that are not finite enter none.
Image shrunk(const Image& image, int width);

/// (a + b) / 2 of R, G, B. Requires: equal sizes, as reference_error() checks.
Image mean_of(const Image& a, const Image& b);

/// PNG of |luminance - reference's| over the reference's, which a hundredth of its mean keeps off zero: violet 0, yellow `most`
/// or more.
Result<std::vector<std::byte>> difference_picture(const Image& image, const Image& reference, double most);

}  // namespace radfarm::cli
