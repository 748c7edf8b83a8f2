#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Light that a person adds to a scene file.
struct AddedLight {
  std::string env;                         // "sky:..." or a map's file; empty: none
  std::map<std::string, std::string> ies;  // name of a light or its node -> IES file
};

/// Gives the scene an environment, and photometries to its lights by name: an IES light keeps its colour and takes its intensity
/// from the file. Files are relative to `folder`, or absolute. INVALID_ARGUMENT where no light has the name; the message lists
/// those that there are.
Status light_scene(const AddedLight& added, const std::filesystem::path& folder, Scene& scene);

}  // namespace radfarm
