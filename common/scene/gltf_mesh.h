#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf_material.h"
#include "scene/gltf_model.h"
#include "scene/scene.h"

namespace radfarm {

/// Turns each primitive with triangles into a Mesh of the scene: strips, fans and unindexed ones become triangle lists,
/// morph targets are applied with their default weights. Coordinates and tangents are read where the material needs
/// them. Returns, per glTF mesh, the scene's meshes it became.
/// Requires: read_gltf_materials has filled scene.materials, the default one last.
Result<std::vector<std::vector<std::uint32_t>>> read_gltf_meshes(const GltfModel& model,
                                                                 std::span<const GltfUvSets> uv_sets, Scene& scene);

}  // namespace radfarm
