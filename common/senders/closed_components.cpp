#include "senders/closed_components.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace radfarm {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Of each vertex, the first one at its position.
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

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t v) {
  while (parents[v] != v) v = parents[v] = parents[parents[v]];
  return v;
}

std::vector<bool> closed_triangles(const Mesh& mesh) {
  const std::vector<std::uint32_t> joined = join_by_position(mesh.positions);
  std::vector<std::uint32_t> parents(mesh.positions.size());
  std::iota(parents.begin(), parents.end(), 0U);
  std::vector<Edge> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = joined[triangle[i]], b = joined[triangle[(i + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b)});
      parents[root_of(parents, a)] = root_of(parents, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_open(mesh.positions.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin != 2) is_open[root_of(parents, edges[begin][0])] = true;
  }
  std::vector<bool> closed;
  for (const auto& triangle : mesh.triangles) closed.push_back(!is_open[root_of(parents, joined[triangle[0]])]);
  return closed;
}

}  // namespace

ClosedComponents::ClosedComponents(const Scene& scene) {
  for (const Instance& instance : scene.instances) mesh_of_.push_back(instance.mesh);
  for (const Mesh& mesh : scene.meshes) closed_.push_back(closed_triangles(mesh));
}

}  // namespace radfarm
