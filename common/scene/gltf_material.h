#pragma once

#include <array>
#include <vector>

#include "scene/gltf_model.h"
#include "scene/scene.h"

namespace radfarm {

/// Where a texture of a material takes its coordinates from: TEXCOORD_<set> of the mesh, then KHR_texture_transform.
struct GltfCoordinates {
  int set = -1;  // -1: no texture, no coordinates
  float offset[2] = {0, 0};
  float scale[2] = {1, 1};
  float rotation = 0;
  friend bool operator==(const GltfCoordinates&, const GltfCoordinates&) = default;
  Vec2 apply(float u, float v) const;
};

/// What Mesh::uv[0] and Mesh::uv[1] hold for meshes of one material.
using GltfUvSlots = std::array<GltfCoordinates, 2>;

/// Maps every material to a Lambertian one (docs/architecture.md, Materials), decodes the textures they use, and
/// appends the default material (rho 1) for primitives that name none. Returns one entry a material: since a Mesh has
/// one material, slot 0 serves its reflectance and slot 1 its emission where that differs, transforms baked in.
Result<std::vector<GltfUvSlots>> read_gltf_materials(const GltfModel& model, Scene& scene);

}  // namespace radfarm
