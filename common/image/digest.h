#pragma once

#include <string>

#include "image/image.h"

namespace radfarm {

/// SHA-256 over size, channel names and pixel floats: equal images have equal digests whatever their files' compression,
/// and attributes do not count. docs/formats.md has the byte order.
std::string image_digest(const Image& image);

}  // namespace radfarm
