#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "scene/gltf_instancing.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

/// glTF stores columns of a matrix for column vectors, which are the rows of ours for row vectors.
Matrix4d local_matrix(const tinygltf::Node& node) {
  Matrix4d matrix;
  if (node.matrix.size() != 16) {
    const auto get = [](const std::vector<double>& values, std::size_t i, double otherwise) {
      return i < values.size() ? values[i] : otherwise;
    };
    const auto& [t, r, s] = std::tie(node.translation, node.rotation, node.scale);
    return matrix_of_trs({get(t, 0, 0), get(t, 1, 0), get(t, 2, 0)},
                         {get(r, 0, 0), get(r, 1, 0), get(r, 2, 0), get(r, 3, 1)},
                         {get(s, 0, 1), get(s, 1, 1), get(s, 2, 1)});
  }
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

/// Where the light's zero azimuth points: its node's +x, made perpendicular to the direction.
Vec3 right_of(const Matrix4d& world, const Vec3& direction) {
  const Vec3d axis = to_double(direction);
  const Vec3d x = normalize(row(world, 0));
  const Vec3d right = x - axis * dot(x, axis);
  return length(right) > 1e-6 ? to_float(normalize(right)) : Frame(direction).tangent;
}

void add_light(const tinygltf::Light& source, const tinygltf::Node& node, const Matrix4d& world, DraftScene& draft) {
  PunctualLight light;
  light.name = source.name.empty() ? node.name : source.name;
  const Vec3d back = row(world, 2);
  if (length(back) > 0) light.direction = to_float(normalize(-back));
  light.right = right_of(world, light.direction);
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
  draft.scene.lights.push_back(std::move(light));
  draft.light_positions.push_back(row(world, 3));
}

int light_of(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end() || !found->second.Has("light")) return -1;
  return found->second.Get("light").GetNumberAsInt();
}

Status check_place(const Matrix4d& world) {
  for (int i = 0; i < 4; ++i) {
    const Vec3d line = row(world, i);
    const double largest = std::max({std::fabs(line.x), std::fabs(line.y), std::fabs(line.z)});
    if (!(largest < limits::kCoordinate)) {
      return fail(Code::kInvalidArgument, "world transform is not finite or beyond 1e18");
    }
  }
  return {};
}

/// An instance of each part of the node's mesh, in each place that EXT_mesh_gpu_instancing gives it.
Status place_mesh(const GltfModel& model, const tinygltf::Node& node, const Matrix4d& world,
                  std::span<const std::uint32_t> parts, DraftScene& draft) {
  if (parts.empty()) return {};
  if (node.skin >= 0) add_note(draft.scene, "Skins are ignored: skinned meshes keep the shape stored in the file.");
  // Both factors are bounded by limits.h, so that their product does not overflow.
  if (draft.scene.instances.size() + gltf_instance_count(model, node) * parts.size() > limits::kInstances) {
    return fail(Code::kResourceExhausted, "scene has more than " + std::to_string(limits::kInstances) + " instances");
  }
  RADFARM_TRY(const std::vector<Matrix4d> places, read_gltf_instances(model, node));
  for (const Matrix4d& place : places) {
    const Matrix4d placed = place * world;
    RADFARM_TRY_STATUS(check_place(placed));
    for (const std::uint32_t mesh : parts) {
      draft.scene.instances.push_back({mesh, Matrix4(), node.name});
      draft.instance_to_world.push_back(placed);
    }
  }
  return {};
}

Status place_node(const GltfModel& model, const tinygltf::Node& node, const Matrix4d& world,
                  std::span<const std::vector<std::uint32_t>> mesh_parts, DraftScene& draft) {
  RADFARM_TRY_STATUS(check_place(world));
  if (node.mesh >= 0) {
    const auto& parts = mesh_parts[static_cast<std::size_t>(node.mesh)];
    RADFARM_TRY_STATUS(place_mesh(model, node, world, parts, draft));
  }
  if (node.camera >= 0) add_camera(model.document.cameras[static_cast<std::size_t>(node.camera)], node, world, draft);
  if (const int light = light_of(node); light >= 0) {
    add_light(model.document.lights.at(static_cast<std::size_t>(light)), node, world, draft);
  }
  if (draft.scene.lights.size() > limits::kLights) {
    return fail(Code::kResourceExhausted, "scene has more than " + std::to_string(limits::kLights) + " lights");
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
