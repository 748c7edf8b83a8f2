#pragma once

#include <array>
#include <vector>

#include "math/vec.h"
#include "scene/gltf_model.h"
#include "scene/json_checker.h"

namespace radfarm {

/// EXT_mesh_gpu_instancing: a node that places its mesh many times.

/// Proves of one node that its attributes exist, have the right types, and are equally many.
void check_gltf_instancing(JsonChecker& checker, const JsonPlace& root, const JsonPlace& node);

/// How often the node places its mesh: 1 without the extension.
std::size_t gltf_instance_count(const GltfModel& model, const tinygltf::Node& node);

/// Where the node places its mesh, relative to the node: the identity without the extension.
Result<std::vector<Matrix4d>> read_gltf_instances(const GltfModel& model, const tinygltf::Node& node);

/// Scale, then rotation (a quaternion x, y, z, w, of any length), then translation, for row vectors.
Matrix4d matrix_of_trs(const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale);

}  // namespace radfarm
