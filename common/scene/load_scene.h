#pragma once

#include <filesystem>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

struct LoadOptions {
  enum class UpAxis { kY, kZ };
  UpAxis up = UpAxis::kY;  // which axis of an OBJ file points up; glTF is always Y
};

/// Reads .gltf, .glb or .obj (by extension), maps it to our structs, recentres, validates.
/// Errors are one line with the file and the JSON pointer or line: NOT_FOUND for a missing file, INVALID_ARGUMENT for
/// contents, RESOURCE_EXHAUSTED above limits.h. Cost: O(file).
Result<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace radfarm
