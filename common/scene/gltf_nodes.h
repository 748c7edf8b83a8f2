#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/draft_scene.h"
#include "scene/gltf_model.h"

namespace radfarm {

/// Walks the default scene (else scene 0, else all root nodes) and adds what its nodes place: an instance per mesh
/// part, cameras and punctual lights, all with world transforms in double. Requires: node trees as check_gltf() proves
/// them. `mesh_parts` is what read_gltf_meshes returned.
Status read_gltf_nodes(const GltfModel& model, std::span<const std::vector<std::uint32_t>> mesh_parts,
                       DraftScene& draft);

/// Moves the nodes to where the file's first animation has them at its start; what it cannot apply it notes.
void pose_at_start(GltfModel& model, Scene& scene);

}  // namespace radfarm
