#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/status.h"
#include "image/image.h"

namespace radfarm {

inline constexpr int kMaxImageSide = 16384;                                  // pixels
inline constexpr std::size_t kMaxImageBytes = std::size_t{4} << 30;          // all channels of one decoded image
inline constexpr std::size_t kMaxImageChannels = 1024;

/// An OpenEXR file of the image: scan lines, 32-bit float, ZIP, Rec.709 chromaticities, attributes as header strings. The
/// same image always gives the same bytes. INVALID_ARGUMENT for sizes over the limits or unusable names.
Result<std::vector<std::byte>> encode_exr(const Image& image);

/// The image of an OpenEXR file: flat, single-part, unsubsampled, scan lines or tiles; half and integer channels become
/// float. The data window's corner becomes pixel (0, 0). Damaged or hostile bytes give DATA_LOSS, what is out of scope
/// UNIMPLEMENTED, what is too large RESOURCE_EXHAUSTED; sizes are checked before anything is allocated.
Result<Image> decode_exr(std::span<const std::byte> bytes);

}  // namespace radfarm
