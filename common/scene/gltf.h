#pragma once

#include <filesystem>

#include "base/status.h"
#include "scene/draft_scene.h"
#include "scene/gltf_source.h"

namespace radfarm {

/// Reads a glTF 2.0 file (.gltf or .glb). Errors are "JSON pointer: what is wrong", without the file's name.
/// docs/formats.md says what is read, what is folded and what is refused.
Result<DraftScene> read_gltf(const std::filesystem::path& path);
Result<DraftScene> read_gltf(GltfSource source);

}  // namespace radfarm
