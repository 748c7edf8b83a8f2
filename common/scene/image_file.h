#pragma once

#include <string_view>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Decodes a PNG, JPEG, BMP or TGA file to 8-bit RGBA. Size limits (limits.h) are checked on the header before any
/// pixel is decoded: RESOURCE_EXHAUSTED. INVALID_ARGUMENT when the bytes are no such image or are cut off.
Result<Texture> decode_image(std::string_view bytes);

}  // namespace radfarm
