#include "scene/components.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/disjoint_sets.h"

namespace radfarm {
namespace {

std::vector<std::uint32_t> parts_of(const Mesh& mesh) {
  const std::vector<std::uint32_t> joined = join_by_position(mesh.positions);
  DisjointSets sets(mesh.positions.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 1; i < 3; ++i) sets.join(joined[triangle[0]], joined[triangle[i]]);
  }
  std::vector<std::uint32_t> parts;
  parts.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) parts.push_back(sets.root(joined[triangle[0]]));
  return parts;
}

}  // namespace

std::vector<std::uint32_t> join_by_position(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), joined(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t v) { return std::tuple(positions[v].x, positions[v].y, positions[v].z, v); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return place(a) < place(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    joined[order[i]] = is_same ? joined[order[i - 1]] : order[i];
  }
  return joined;
}

Components::Components(const Scene& scene) {
  for (const Instance& instance : scene.instances) mesh_of_.push_back(instance.mesh);
  for (const Mesh& mesh : scene.meshes) parts_.push_back(parts_of(mesh));
}

}  // namespace radfarm
