#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/status.h"

namespace radfarm {

/// What a scene file may refer to: files in its own folder or below, and data URIs. Everything else is refused, because
/// a scene comes from a stranger and is read by a service.

/// The path, relative to the scene's folder, that a glTF URI names; percent-encoding is undone first.
/// INVALID_ARGUMENT for schemes, absolute paths, and paths that leave the folder.
Result<std::filesystem::path> path_of_uri(std::string_view uri);

/// The same for a file name in an OBJ or MTL file: backslashes separate folders, nothing is encoded.
Result<std::filesystem::path> path_of_name(std::string_view name);

[[nodiscard]] bool is_data_uri(std::string_view uri);
/// The bytes of a base64 data URI.
Result<std::string> decode_data_uri(std::string_view uri);

/// The bytes behind a URI in a scene in `folder`.
Result<std::string> read_uri(const std::filesystem::path& folder, std::string_view uri, std::size_t max_bytes);

}  // namespace radfarm
