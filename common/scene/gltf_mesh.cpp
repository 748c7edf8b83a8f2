#include "scene/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "scene/draft_scene.h"
#include "scene/gltf_accessor.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Vec3> to_vectors(const std::vector<float>& values) {
  std::vector<Vec3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

/// The corner indices in file order; each below the number of vertices and none the primitive restart value.
Result<std::vector<std::uint32_t>> corner_indices(const GltfModel& model, const tinygltf::Primitive& primitive,
                                                  std::size_t vertices) {
  if (primitive.indices < 0) {
    std::vector<std::uint32_t> indices(vertices);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
  }
  std::vector<std::uint32_t> indices = read_indices(model, primitive.indices);
  const int type = model.document.accessors[static_cast<std::size_t>(primitive.indices)].componentType;
  std::uint32_t restart = 0xffffffffU;
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) restart = 0xffU;
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) restart = 0xffffU;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < vertices && indices[i] != restart) continue;
    return fail(Code::kInvalidArgument,
                "/indices: value " + std::to_string(indices[i]) + " at position " + std::to_string(i) +
                    (indices[i] == restart ? " is the primitive restart value" : " is out of range") + " (there are " +
                    std::to_string(vertices) + " vertices)");
  }
  return indices;
}

std::vector<Triangle> assemble_triangles(int mode, const std::vector<std::uint32_t>& corners) {
  std::vector<Triangle> triangles;
  const std::size_t count = corners.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(count / 3);
    for (std::size_t i = 0; i + 2 < count; i += 3) triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
    } else {
      // Every second triangle of a strip turns the other way.
      triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    }
  }
  return triangles;
}

/// Adds the morph targets with the mesh's default weights to `values` (positions or normals).
Status add_morphs(const GltfModel& model, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                  const std::string& name, std::vector<float>& values) {
  for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
    const auto target = primitive.targets[t].find(name);
    if (target == primitive.targets[t].end() || weights[t] == 0) continue;
    RADFARM_TRY(const std::vector<float> delta, read_floats(model, target->second, 3));
    for (std::size_t i = 0; i < values.size() && i < delta.size(); ++i) {
      values[i] += static_cast<float>(weights[t]) * delta[i];
    }
  }
  return {};
}

/// The coordinates that the material's textures use, as stored; also those that only give anisotropy its direction.
Status read_uvs(const GltfModel& model, const tinygltf::Primitive& primitive, GltfUvSets sets, Scene& scene,
                Mesh& mesh) {
  const bool turns_gloss = scene.materials[mesh.material].anisotropy > 0;
  if (sets[0] == kNone && turns_gloss && attribute(primitive, "TEXCOORD_0") >= 0) sets[0] = 0;
  for (std::size_t slot = 0; slot < sets.size(); ++slot) {
    if (sets[slot] == kNone) continue;
    const std::string name = "TEXCOORD_" + std::to_string(sets[slot]);
    const int accessor = attribute(primitive, name);
    mesh.uv[slot].assign(mesh.positions.size(), Vec2(0, 0));
    if (accessor < 0) {
      add_note(scene, "Textured meshes without " + name + " show the texture's first corner only.");
      continue;
    }
    RADFARM_TRY(const std::vector<float> values, read_floats(model, accessor, 2));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.uv[slot][i] = {values[2 * i], values[2 * i + 1]};
  }
  return {};
}

/// Tangents where the material needs them. Without normals they mean nothing, says glTF; where one is none, all go.
Status read_tangents(const GltfModel& model, const tinygltf::Primitive& primitive, const Material& material,
                     Mesh& mesh) {
  const int accessor = attribute(primitive, "TANGENT");
  const bool needed = material.normal_texture.is_used() || material.anisotropy > 0;
  if (accessor < 0 || !needed || mesh.normals.empty()) return {};
  RADFARM_TRY(const std::vector<float> values, read_floats(model, accessor, 4));
  std::vector<std::array<float, 4>> tangents;
  tangents.reserve(values.size() / 4);
  for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
    const Vec3d tangent(values[i], values[i + 1], values[i + 2]);
    const float side = values[i + 3];
    if (!(length(tangent) > 1e-6) || std::fabs(std::fabs(side) - 1) > 0.01F) return {};
    const Vec3 unit = to_float(normalize(tangent));
    tangents.push_back({unit.x, unit.y, unit.z, side > 0 ? 1.0F : -1.0F});
  }
  mesh.tangents = std::move(tangents);
  return {};
}

Status read_colors(const GltfModel& model, const tinygltf::Primitive& primitive, Scene& scene, Mesh& mesh) {
  const int accessor = attribute(primitive, "COLOR_0");
  if (accessor < 0) return {};
  RADFARM_TRY(const std::vector<float> values, read_floats(model, accessor, 4));
  mesh.colors.resize(values.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::clamp(values[i], 0.0F, 1.0F);
    if (value != values[i]) add_note(scene, "Vertex colours outside [0, 1] are clamped.");
    mesh.colors[i / 4][i % 4] = value;
  }
  return {};
}

bool has_triangles(const tinygltf::Primitive& primitive, Scene& scene) {
  if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    add_note(scene, "Points and lines are skipped: they have no area.");
    return false;
  }
  if (attribute(primitive, "POSITION") >= 0) return true;
  add_note(scene, "Primitives without POSITION are skipped.");
  return false;
}

Result<Mesh> read_primitive(const GltfModel& model, const tinygltf::Mesh& source, const tinygltf::Primitive& primitive,
                            std::span<const GltfUvSets> uv_sets, Scene& scene) {
  Mesh mesh;
  mesh.name = source.name;
  mesh.material = primitive.material < 0 ? static_cast<std::uint32_t>(uv_sets.size() - 1)
                                         : static_cast<std::uint32_t>(primitive.material);
  RADFARM_TRY(std::vector<float> positions, read_floats(model, attribute(primitive, "POSITION"), 3));
  RADFARM_TRY_STATUS(add_morphs(model, primitive, source.weights, "POSITION", positions));
  mesh.positions = to_vectors(positions);
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  RADFARM_TRY(const std::vector<std::uint32_t> corners, corner_indices(model, primitive, mesh.positions.size()));
  mesh.triangles = assemble_triangles(mode, corners);
  if (const int normals = attribute(primitive, "NORMAL"); normals >= 0) {
    RADFARM_TRY(std::vector<float> values, read_floats(model, normals, 3));
    RADFARM_TRY_STATUS(add_morphs(model, primitive, source.weights, "NORMAL", values));
    mesh.normals = to_vectors(values);
  }
  RADFARM_TRY_STATUS(read_uvs(model, primitive, uv_sets[mesh.material], scene, mesh));
  RADFARM_TRY_STATUS(read_tangents(model, primitive, scene.materials[mesh.material], mesh));
  RADFARM_TRY_STATUS(read_colors(model, primitive, scene, mesh));
  return mesh;
}

}  // namespace

Result<std::vector<std::vector<std::uint32_t>>> read_gltf_meshes(const GltfModel& model,
                                                                 std::span<const GltfUvSets> uv_sets, Scene& scene) {
  std::vector<std::vector<std::uint32_t>> parts;
  std::size_t triangles = 0;
  for (std::size_t m = 0; m < model.document.meshes.size(); ++m) {
    const tinygltf::Mesh& source = model.document.meshes[m];
    parts.emplace_back();
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = source.primitives[p];
      const std::string pointer = "/meshes/" + std::to_string(m) + "/primitives/" + std::to_string(p);
      if (!has_triangles(primitive, scene)) continue;
      if (!primitive.targets.empty()) add_note(scene, "Morph targets keep their default weights.");
      auto mesh = read_primitive(model, source, primitive, uv_sets, scene);
      if (!mesh && mesh.error().message.starts_with("/accessors")) return tl::unexpected(mesh.error());
      if (!mesh) return fail(mesh.error().code, pointer + mesh.error().message);
      triangles += mesh->triangles.size();
      if (triangles > limits::kTriangles) {
        return fail(Code::kResourceExhausted,
                    pointer + ": scene has more than " + std::to_string(limits::kTriangles) + " triangles");
      }
      parts.back().push_back(static_cast<std::uint32_t>(scene.meshes.size()));
      scene.meshes.push_back(std::move(*mesh));
    }
  }
  return parts;
}

}  // namespace radfarm
