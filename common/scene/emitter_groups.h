#pragma once

#include <string>
#include <vector>

#include "scene/world.h"

namespace radfarm {

/// Emitters that are dimmed together: surfaces of the materials of one name, punctual lights of one name, or the sky with its
/// sun.
struct EmitterGroup {
  std::string name;  // a part of a channel's name and a file's name: letters, digits, - and _ of ASCII; other characters as they are
  double flux = 0;   // lm
  Shining shining;   // only these
};

/// The groups of a world's emitters, each emitter in one of them: by material, by light, "environment"; each in the scene's
/// order. A light without name of its own goes by its node's (gltf_nodes.h). Those without any name are numbered, each a group of
/// its own: "material_1", "light_1"; a name that another group has, or would have once made safe, is numbered from 2. Groups
/// without power are left out. Requires: a world where all shine. Cost: O(emitters + materials x groups).
std::vector<EmitterGroup> emitter_groups(const World& world);

}  // namespace radfarm
