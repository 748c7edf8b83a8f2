#pragma once

#include <array>
#include <vector>

#include "scene/gltf_model.h"
#include "scene/gltf_texture.h"
#include "scene/scene.h"

namespace radfarm {

/// Which TEXCOORD_n of the file Mesh::uv[0] and Mesh::uv[1] hold for meshes of one material; kNone where its textures
/// use no such set. Sets 0 and 1 keep their places, one of a higher number takes a place that is left.
using GltfUvSets = std::array<std::uint32_t, 2>;

/// Reads every material (docs/materials.md), decodes the textures they use, and appends glTF's default material (white,
/// metallic 1, roughness 1) for primitives that name none. A texture on a factor of zero is not read. Returns one entry
/// a material. UNIMPLEMENTED for one whose textures use more than two sets of coordinates.
Result<std::vector<GltfUvSets>> read_gltf_materials(const GltfModel& model, Scene& scene);

/// The lobes that extensions of the core material add (KHR_materials_specular, ior, transmission, volume, clearcoat,
/// sheen, anisotropy), as far as `source` has them. Sets `specular` to 1, glTF's default, where nothing else is said.
Status read_gltf_layers(const nlohmann::json& source, GltfTextureReader& textures, Scene& scene, Material& material);

}  // namespace radfarm
