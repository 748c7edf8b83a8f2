#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/limits.h"

namespace radfarm {
namespace {

/// Row vectors: scale first, then rotation, then translation.
Matrix4d matrix_of_trs(const tinygltf::Node& node) {
  const auto get = [](const std::vector<double>& values, std::size_t i, double otherwise) {
    return i < values.size() ? values[i] : otherwise;
  };
  double x = get(node.rotation, 0, 0);
  double y = get(node.rotation, 1, 0);
  double z = get(node.rotation, 2, 0);
  double w = get(node.rotation, 3, 1);
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  if (norm > 0) {
    x /= norm, y /= norm, z /= norm, w /= norm;
  } else {
    w = 1;
  }
  const double rotation[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
      {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
      {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
  };
  Matrix4d matrix;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      matrix[static_cast<int>(row)][column] = get(node.scale, row, 1) * rotation[row][column];
    }
    matrix[3][row] = get(node.translation, row, 0);
  }
  return matrix;
}

/// glTF stores columns of a matrix for column vectors, which are the rows of ours for row vectors.
Matrix4d local_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() != 16) return matrix_of_trs(node);
  Matrix4d matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[static_cast<int>(i / 4)][i % 4] = node.matrix[i];
  return matrix;
}

Vec3d row(const Matrix4d& matrix, int index) { return {matrix[index][0], matrix[index][1], matrix[index][2]}; }

void add_camera(const tinygltf::Camera& source, const tinygltf::Node& node, const Matrix4d& world, DraftScene& draft) {
  const Vec3d back = row(world, 2);
  const Vec3d right = cross(row(world, 1), back);
  if (!(length(back) > 0) || !(length(right) > 0)) {
    return add_note(draft.scene, "Cameras under a node of zero scale are dropped.");
  }
  Camera camera;
  camera.name = node.name.empty() ? source.name : node.name;
  camera.forward = to_float(normalize(-back));
  camera.right = to_float(normalize(right));
  camera.up = to_float(normalize(cross(back, right)));
  if (source.type == "orthographic") {
    camera.kind = Camera::Kind::kOrthographic;
    camera.half_height = static_cast<float>(std::fabs(source.orthographic.ymag) * length(row(world, 1)));
    const double half_width = std::fabs(source.orthographic.xmag) * length(row(world, 0));
    camera.aspect = static_cast<float>(half_width / static_cast<double>(camera.half_height));
  } else {
    camera.vertical_fov = static_cast<float>(source.perspective.yfov);
    camera.aspect = static_cast<float>(source.perspective.aspectRatio);
  }
  draft.scene.cameras.push_back(std::move(camera));
  draft.camera_positions.push_back(row(world, 3));
}

void add_light(const tinygltf::Light& source, const Matrix4d& world, DraftScene& draft) {
  PunctualLight light;
  const Vec3d back = row(world, 2);
  if (length(back) > 0) light.direction = to_float(normalize(-back));
  if (source.type == "spot") light.kind = PunctualLight::Kind::kSpot;
  if (source.type == "directional") light.kind = PunctualLight::Kind::kDirectional;
  if (light.kind == PunctualLight::Kind::kSpot) {
    light.cos_inner = static_cast<float>(std::cos(source.spot.innerConeAngle));
    light.cos_outer = static_cast<float>(std::max(0.0, std::cos(source.spot.outerConeAngle)));
  }
  light.intensity = Spectrum(static_cast<float>(source.intensity));
  if (source.color.size() == 3) {
    const SpectrumD color(source.color[0], source.color[1], source.color[2]);
    light.intensity = Spectrum(color * source.intensity);
  }
  if (source.range > 0) add_note(draft.scene, "The range of punctual lights is ignored: they shine to infinity.");
  draft.scene.lights.push_back(light);
  draft.light_positions.push_back(row(world, 3));
}

int light_of(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end() || !found->second.Has("light")) return -1;
  return found->second.Get("light").GetNumberAsInt();
}

Status place_node(const GltfModel& model, const tinygltf::Node& node, const Matrix4d& world,
                  std::span<const std::vector<std::uint32_t>> mesh_parts, DraftScene& draft) {
  for (int i = 0; i < 4; ++i) {
    const Vec3d line = row(world, i);
    const double largest = std::max({std::fabs(line.x), std::fabs(line.y), std::fabs(line.z)});
    if (!(largest < limits::kCoordinate)) {
      return fail(Code::kInvalidArgument, "world transform is not finite or beyond 1e18");
    }
  }
  if (node.mesh >= 0) {
    if (node.skin >= 0) add_note(draft.scene, "Skins are ignored: skinned meshes keep the shape stored in the file.");
    for (const std::uint32_t mesh : mesh_parts[static_cast<std::size_t>(node.mesh)]) {
      draft.scene.instances.push_back({mesh, Matrix4(), node.name});
      draft.instance_to_world.push_back(world);
    }
  }
  if (node.camera >= 0) add_camera(model.document.cameras[static_cast<std::size_t>(node.camera)], node, world, draft);
  if (const int light = light_of(node); light >= 0) {
    add_light(model.document.lights.at(static_cast<std::size_t>(light)), world, draft);
  }
  if (draft.scene.instances.size() > limits::kInstances || draft.scene.lights.size() > limits::kLights) {
    return fail(Code::kResourceExhausted, "scene has more than " + std::to_string(limits::kInstances) +
                                              " instances or " + std::to_string(limits::kLights) + " lights");
  }
  return {};
}

/// The nodes to start from.
std::vector<int> root_nodes(const tinygltf::Model& document, Scene& scene) {
  if (!document.scenes.empty()) {
    const auto index = static_cast<std::size_t>(std::max(document.defaultScene, 0));
    if (document.scenes.size() > 1) {
      add_note(scene, "The file has " + std::to_string(document.scenes.size()) + " scenes; scene " +
                          std::to_string(index) + " is taken.");
    }
    return document.scenes[index].nodes;
  }
  std::vector<char> is_child(document.nodes.size(), 0);
  for (const tinygltf::Node& node : document.nodes) {
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = 1;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (is_child[i] == 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

}  // namespace

Status read_gltf_nodes(const GltfModel& model, std::span<const std::vector<std::uint32_t>> mesh_parts,
                       DraftScene& draft) {
  struct Visit {
    int node;
    Matrix4d parent;
  };
  // Depth first, children in file order.
  std::vector<Visit> stack;
  const std::vector<int> roots = root_nodes(model.document, draft.scene);
  for (auto it = roots.rbegin(); it != roots.rend(); ++it) stack.push_back({*it, Matrix4d()});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const tinygltf::Node& node = model.document.nodes[static_cast<std::size_t>(visit.node)];
    const Matrix4d world = local_matrix(node) * visit.parent;
    if (const Status status = place_node(model, node, world, mesh_parts, draft); !status) {
      return annotate(status.error(), "/nodes/" + std::to_string(visit.node));
    }
    for (auto it = node.children.rbegin(); it != node.children.rend(); ++it) stack.push_back({*it, world});
  }
  return {};
}

}  // namespace radfarm
