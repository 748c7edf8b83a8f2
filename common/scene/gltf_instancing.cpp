#include "scene/gltf_instancing.h"

#include <array>
#include <cmath>
#include <string>

#include "scene/gltf_accessor.h"
#include "scene/gltf_check.h"
#include "scene/gltf_values.h"

namespace radfarm {
namespace {

constexpr const char* kName = "EXT_mesh_gpu_instancing";

/// The accessor of one of the node's instance attributes; -1 for none.
int instance_attribute(const tinygltf::Node& node, const std::string& attribute) {
  const auto found = node.extensions.find(kName);
  if (found == node.extensions.end() || !found->second.Has("attributes")) return -1;
  const tinygltf::Value& attributes = found->second.Get("attributes");
  return attributes.Has(attribute) ? attributes.Get(attribute).GetNumberAsInt() : -1;
}

/// The attribute's numbers, or `otherwise` for every instance.
Result<std::vector<float>> attribute_values(const GltfModel& model, int accessor, std::size_t count,
                                            const std::vector<float>& otherwise) {
  if (accessor >= 0) return read_floats(model, accessor, otherwise.size());
  std::vector<float> values;
  values.reserve(count * otherwise.size());
  for (std::size_t i = 0; i < count; ++i) values.insert(values.end(), otherwise.begin(), otherwise.end());
  return values;
}

}  // namespace

void check_gltf_instancing(JsonChecker& checker, const JsonPlace& root, const JsonPlace& node) {
  const JsonPlace extension = node.extension(kName);
  if (!checker.ok() || !extension.has("attributes")) return;
  const JsonPlace attributes = extension.at("attributes");
  std::size_t count = 0;
  for (const auto& [name, type] : {std::pair("TRANSLATION", "VEC3"), {"ROTATION", "VEC4"}, {"SCALE", "VEC3"}}) {
    if (!attributes.has(name)) continue;
    const JsonPlace place = attributes.at(name);
    checker.index(attributes, name, "accessor", count_of(root, "accessors"));
    if (!checker.ok()) return;
    const nlohmann::json& accessor = *root.at("accessors").at(place.value->get<std::size_t>()).value;
    if (accessor.at("type") != type) return checker.fault(place.pointer, std::string("must be a ") + type);
    const auto here = accessor.at("count").get<std::size_t>();
    if (count != 0 && here != count) return checker.fault(place.pointer, "has another count than other attributes");
    count = here;
  }
}

std::size_t gltf_instance_count(const GltfModel& model, const tinygltf::Node& node) {
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    const int accessor = instance_attribute(node, name);
    if (accessor >= 0) return model.document.accessors.at(static_cast<std::size_t>(accessor)).count;
  }
  return 1;
}

Result<std::vector<Matrix4d>> read_gltf_instances(const GltfModel& model, const tinygltf::Node& node) {
  const std::size_t count = gltf_instance_count(model, node);
  RADFARM_TRY(const std::vector<float> t,
              attribute_values(model, instance_attribute(node, "TRANSLATION"), count, {0, 0, 0}));
  RADFARM_TRY(const std::vector<float> r,
              attribute_values(model, instance_attribute(node, "ROTATION"), count, {0, 0, 0, 1}));
  RADFARM_TRY(const std::vector<float> s, attribute_values(model, instance_attribute(node, "SCALE"), count, {1, 1, 1}));
  std::vector<Matrix4d> matrices;
  matrices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    matrices.push_back(matrix_of_trs({t[3 * i], t[3 * i + 1], t[3 * i + 2]},
                                     {r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]},
                                     {s[3 * i], s[3 * i + 1], s[3 * i + 2]}));
  }
  return matrices;
}

Matrix4d matrix_of_trs(const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale) {
  auto [x, y, z, w] = rotation;
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  if (norm > 0) {
    x /= norm, y /= norm, z /= norm, w /= norm;
  } else {
    w = 1;
  }
  const double turned[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
      {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
      {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
  };
  Matrix4d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[row][column] = scale[row] * turned[row][column];
    matrix[3][row] = translation[row];
  }
  return matrix;
}

}  // namespace radfarm
