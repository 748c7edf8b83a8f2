#include "scene/gltf_check.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/gltf_draco.h"
#include "scene/gltf_meshopt.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr std::size_t kLargestOffset = limits::kSceneFileBytes;

/// Required extensions that load: those we follow, and lobes that we leave out with a note.
constexpr std::array<std::string_view, 20> kSupported = {
    "KHR_lights_punctual",      "KHR_materials_emissive_strength", "KHR_materials_specular",
    "KHR_materials_unlit",      "KHR_texture_transform",           "KHR_mesh_quantization",
    "KHR_materials_ior",        "KHR_materials_transmission",      "KHR_materials_volume",
    "KHR_materials_clearcoat",  "KHR_materials_sheen",             "KHR_materials_iridescence",
    "KHR_materials_anisotropy", "KHR_materials_dispersion",        "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_variants",   "KHR_materials_diffuse_transmission", "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",  "EXT_mesh_gpu_instancing"};

void check_version(JsonChecker& checker, const JsonPlace& root) {
  checker.require(root, "asset");
  if (!checker.ok()) return;
  const JsonPlace asset = root.at("asset");
  checker.require(asset, "version");
  checker.string(asset, "version");
  checker.string(asset, "minVersion");
  if (!checker.ok()) return;
  const auto version = asset.value->at("version").get<std::string>();
  if (!version.starts_with("2.")) checker.fault(asset.pointer + "/version", "is '" + version + "', must be 2.x");
  const auto needed = asset.value->value("minVersion", std::string("2.0"));
  if (needed != "2.0") checker.fault(asset.pointer + "/minVersion", "is '" + needed + "', this build reads 2.0");
}

void check_extensions(JsonChecker& checker, const JsonPlace& root) {
  if (!root.has("extensionsRequired")) return;
  const JsonPlace required = root.at("extensionsRequired");
  if (!required.value->is_array()) return checker.fault(required.pointer, "must be an array");
  for (std::size_t i = 0; i < required.value->size(); ++i) {
    const JsonPlace place = required.at(i);
    if (!place.value->is_string()) return checker.fault(place.pointer, "must be a string");
    const auto name = place.value->get<std::string>();
    if (std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end()) continue;
    checker.fault(place.pointer, "required extension " + name + " is not supported", Code::kUnimplemented);
  }
}

void check_buffers(JsonChecker& checker, const JsonPlace& root) {
  checker.each_object(root, "buffers", [&](const JsonPlace& buffer) {
    checker.require(buffer, "byteLength");
    checker.integer(buffer, "byteLength", 0, 1, limits::kSceneFileBytes);
    checker.string(buffer, "uri");
  });
  checker.each_object(root, "bufferViews", [&](const JsonPlace& view) {
    checker.require(view, "buffer");
    checker.require(view, "byteLength");
    checker.index(view, "buffer", "buffer", count_of(root, "buffers"));
    const std::size_t offset = checker.integer(view, "byteOffset", 0, 0, kLargestOffset);
    const std::size_t length = checker.integer(view, "byteLength", 0, 1, kLargestOffset);
    const std::size_t stride = checker.integer(view, "byteStride", 4, 4, 252);
    if (!checker.ok()) return;
    if (stride % 4 != 0) checker.fault(view.pointer + "/byteStride", "must be a multiple of 4");
    const auto buffer = view.value->at("buffer").get<std::size_t>();
    const auto available = root.at("buffers").at(buffer).value->at("byteLength").get<std::size_t>();
    if (offset + length > available) {
      checker.fault(view.pointer, "ends at byte " + std::to_string(offset + length) + " of buffer " +
                                      std::to_string(buffer) + ", which has " + std::to_string(available));
    }
    check_gltf_meshopt(checker, root, view);
  });
}

/// `count` elements of `element` bytes, `stride` apart (0: tightly), from `offset` on lie inside a buffer view.
void check_range(JsonChecker& checker, const JsonPlace& root, const JsonPlace& place, std::size_t count,
                 std::size_t element) {
  checker.require(place, "bufferView");
  checker.index(place, "bufferView", "bufferView", count_of(root, "bufferViews"));
  const std::size_t offset = checker.integer(place, "byteOffset", 0, 0, 0x7fffffff);
  if (!checker.ok()) return;
  const nlohmann::json& view = *root.at("bufferViews").at(place.value->at("bufferView").get<std::size_t>()).value;
  const std::size_t stride = view.value("byteStride", element);
  if (stride < element) return checker.fault(place.pointer, "byteStride is smaller than an element");
  const std::size_t end = offset + stride * (count - 1) + element;
  const auto available = view.at("byteLength").get<std::size_t>();
  if (end <= available) return;
  checker.fault(place.pointer, "ends at byte " + std::to_string(end) + " of bufferView " +
                                   std::to_string(place.value->at("bufferView").get<std::size_t>()) + ", which has " +
                                   std::to_string(available));
}

void check_component_type(JsonChecker& checker, const JsonPlace& place) {
  checker.require(place, "componentType");
  const std::size_t type = checker.integer(place, "componentType", 0, 0, 65535);
  if (checker.ok() && component_bytes(type) == 0) {
    checker.fault(place.pointer + "/componentType", std::to_string(type) + " is not a component type");
  }
}

void check_sparse(JsonChecker& checker, const JsonPlace& root, const JsonPlace& sparse, std::size_t total,
                  std::size_t element) {
  checker.require(sparse, "count");
  checker.require(sparse, "indices");
  checker.require(sparse, "values");
  const std::size_t count = checker.integer(sparse, "count", 1, 1, total);
  if (!checker.ok()) return;
  check_component_type(checker, sparse.at("indices"));
  if (!checker.ok()) return;
  const auto type = sparse.at("indices").value->at("componentType").get<std::size_t>();
  if (type != 5121 && type != 5123 && type != 5125) {
    return checker.fault(sparse.pointer + "/indices/componentType", "must be an unsigned integer type");
  }
  check_range(checker, root, sparse.at("indices"), count, component_bytes(type));
  check_range(checker, root, sparse.at("values"), count, element);
}

void check_accessors(JsonChecker& checker, const JsonPlace& root) {
  checker.each_object(root, "accessors", [&](const JsonPlace& accessor) {
    check_component_type(checker, accessor);
    checker.require(accessor, "type");
    checker.string(accessor, "type");
    checker.require(accessor, "count");
    const std::size_t count = checker.integer(accessor, "count", 1, 1, limits::kVertices);
    if (!checker.ok()) return;
    const std::size_t components = component_count(accessor.value->at("type").get<std::string>());
    if (components == 0) return checker.fault(accessor.pointer + "/type", "is not an accessor type");
    const std::size_t element = components * component_bytes(accessor.value->at("componentType").get<std::size_t>());
    if (accessor.has("bufferView")) check_range(checker, root, accessor, count, element);
    if (accessor.has("normalized") && !accessor.at("normalized").value->is_boolean()) {
      checker.fault(accessor.pointer + "/normalized", "must be true or false");
    }
    if (checker.ok() && accessor.has("sparse")) check_sparse(checker, root, accessor.at("sparse"), count, element);
  });
}

/// An object whose values are accessors of `vertices` elements (0: the first one decides).
void check_attributes(JsonChecker& checker, const JsonPlace& root, const JsonPlace& attributes, std::size_t& vertices) {
  if (!attributes.value->is_object()) return checker.fault(attributes.pointer, "must be an object");
  for (const auto& [name, accessor] : attributes.value->items()) {
    checker.index(attributes, name, "accessor", count_of(root, "accessors"));
    if (!checker.ok()) return;
    const auto count = root.at("accessors").at(accessor.get<std::size_t>()).value->at("count").get<std::size_t>();
    if (vertices == 0) vertices = count;
    if (count == vertices) continue;
    return checker.fault(attributes.at(name).pointer, "has " + std::to_string(count) + " elements, other attributes " +
                                                          std::to_string(vertices));
  }
}

void check_primitive(JsonChecker& checker, const JsonPlace& root, const JsonPlace& primitive) {
  checker.require(primitive, "attributes");
  checker.integer(primitive, "mode", 4, 0, 6);
  checker.index(primitive, "material", "material", count_of(root, "materials"));
  checker.index(primitive, "indices", "accessor", count_of(root, "accessors"));
  if (!checker.ok()) return;
  std::size_t vertices = 0;
  check_attributes(checker, root, primitive.at("attributes"), vertices);
  checker.each_object(primitive, "targets", [&](const JsonPlace& target) {
    check_attributes(checker, root, target, vertices);
  });
  check_gltf_draco(checker, root, primitive);
  if (!checker.ok() || !primitive.has("indices")) return;
  const nlohmann::json& indices = *root.at("accessors").at(primitive.value->at("indices").get<std::size_t>()).value;
  const auto type = indices.at("componentType").get<std::size_t>();
  if (indices.at("type") != "SCALAR" || (type != 5121 && type != 5123 && type != 5125)) {
    checker.fault(primitive.pointer + "/indices", "must name a SCALAR accessor of an unsigned integer type");
  } else if (!indices.contains("bufferView") && !has_draco(*primitive.value)) {
    checker.fault(primitive.pointer + "/indices", "names an accessor without bufferView");
  }
}

}  // namespace

std::size_t count_of(const JsonPlace& root, const std::string& array) {
  return root.has(array) && root.at(array).value->is_array() ? root.at(array).value->size() : 0;
}

std::size_t component_bytes(std::size_t component_type) {
  switch (component_type) {
    case 5120:
    case 5121: return 1;
    case 5122:
    case 5123: return 2;
    case 5125:
    case 5126: return 4;
    default: return 0;
  }
}

std::size_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

void check_gltf_data(JsonChecker& checker, const JsonPlace& root) {
  check_version(checker, root);
  check_extensions(checker, root);
  check_buffers(checker, root);
  check_accessors(checker, root);
  checker.each_object(root, "images", [&](const JsonPlace& image) {
    checker.string(image, "uri");
    checker.index(image, "bufferView", "bufferView", count_of(root, "bufferViews"));
  });
  checker.each_object(root, "meshes", [&](const JsonPlace& mesh) {
    checker.require(mesh, "primitives");
    checker.each_object(mesh, "primitives", [&](const JsonPlace& place) { check_primitive(checker, root, place); });
    if (checker.ok() && mesh.has("weights") && !mesh.at("weights").value->is_array()) {
      checker.fault(mesh.pointer + "/weights", "must be an array of numbers");
    }
  });
}

Status check_gltf(const nlohmann::json& document) {
  JsonChecker checker;
  const JsonPlace root{&document, ""};
  if (!document.is_object()) checker.fault("", "must be an object");
  if (checker.ok()) check_gltf_data(checker, root);
  if (checker.ok()) check_gltf_scene(checker, root);
  return checker.status();
}

}  // namespace radfarm
