#pragma once

#include <filesystem>

#include "base/status.h"
#include "scene/draft_scene.h"
#include "scene/load_scene.h"

namespace radfarm {

/// Reads an OBJ file with its MTL files: one Mesh and one Instance for each (group or object, material), polygons cut
/// into triangles, positions kept in double until recentring. Errors are "line N: what is wrong", without the file's
/// name.
Result<DraftScene> read_obj(const std::filesystem::path& path, LoadOptions::UpAxis up);

}  // namespace radfarm
