#pragma once

#include <filesystem>
#include <vector>

#include "base/status.h"

namespace radfarm {

/// The files a scene consists of, relative to its folder: itself first, then what it refers to, each once: buffers and
/// images of a glTF file, material libraries of an OBJ file and their textures. This is what `radfarm submit` uploads.
/// Every file is one that load_scene() may read; whether it exists is not checked. Material libraries that do not exist
/// are left out, as load_scene() leaves them out.
Result<std::vector<std::filesystem::path>> scene_files(const std::filesystem::path& scene);

}  // namespace radfarm
