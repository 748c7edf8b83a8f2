#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/status.h"

namespace radfarm {

/// A glTF file taken apart, nothing checked but its container: the JSON, and the binary chunk of a .glb.
struct GltfSource {
  nlohmann::json json;
  std::string binary;
  bool is_binary = false;        // whether `binary` is there: buffer 0 without URI means it
  std::filesystem::path folder;  // what URIs are relative to
};

/// Reads a .gltf or .glb file (told apart by the first four bytes). Errors: INVALID_ARGUMENT for a damaged container or
/// JSON, with the line or byte; RESOURCE_EXHAUSTED above limits.h.
Result<GltfSource> read_gltf_source(const std::filesystem::path& path);

/// The same from bytes in memory.
Result<GltfSource> split_gltf(std::string_view bytes, const std::filesystem::path& folder);

}  // namespace radfarm
