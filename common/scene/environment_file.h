#pragma once

#include <filesystem>
#include <string_view>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Reads a latitude-longitude map: a Radiance picture (.hdr, .pic) or an OpenEXR file (.exr) of channels R, G, B or Y,
/// told apart by their first bytes. Its values are taken as cd/m^2; the left edge looks along -z, the middle along +z.
/// Numbers below 0 become 0; infinite or undefined ones, and a shape other than 2:1 within 1 %, are INVALID_ARGUMENT.
/// Messages name the file.
Result<Environment> read_environment(const std::filesystem::path& path);

/// The same from a file's bytes.
Result<Environment> decode_environment(std::string_view bytes);

}  // namespace radfarm
