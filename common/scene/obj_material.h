#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/status.h"
#include "scene/obj_scan.h"
#include "scene/scene.h"

namespace radfarm {

/// The materials of all libraries by name. The last material of the scene is the one for faces that name none.
using ObjMaterials = std::map<std::string, std::uint32_t>;

/// Reads the MTL files that an OBJ names, with their textures, into scene.materials (docs/materials.md, OBJ). One that
/// does not exist is a note with the line that names it; reflectances and emissions out of range are errors with file,
/// line and material.
Result<ObjMaterials> read_obj_materials(const std::filesystem::path& folder, const ObjScan& scan, Scene& scene);

/// The files that a "mtllib" line names: one, whose name may contain blanks, if it exists; else one a word.
std::vector<std::string> library_names(const std::filesystem::path& folder, const std::string& line);

/// The texture files that an MTL file's materials use, as written.
std::vector<std::string> texture_names(const std::string& mtl_text);

}  // namespace radfarm
