#include "senders/closed_components.h"

#include <algorithm>
#include <array>

#include "base/disjoint_sets.h"
#include "scene/components.h"

namespace radfarm {
namespace {

using Edge = std::array<std::uint32_t, 2>;

std::vector<bool> closed_triangles(const Mesh& mesh) {
  const std::vector<std::uint32_t> joined = join_by_position(mesh.positions);
  DisjointSets parts(mesh.positions.size());
  std::vector<Edge> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = joined[triangle[i]], b = joined[triangle[(i + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b)});
      parts.join(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_open(mesh.positions.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin != 2) is_open[parts.root(edges[begin][0])] = true;
  }
  std::vector<bool> closed;
  for (const auto& triangle : mesh.triangles) closed.push_back(!is_open[parts.root(joined[triangle[0]])]);
  return closed;
}

}  // namespace

ClosedComponents::ClosedComponents(const Scene& scene) {
  for (const Instance& instance : scene.instances) mesh_of_.push_back(instance.mesh);
  for (const Mesh& mesh : scene.meshes) closed_.push_back(closed_triangles(mesh));
}

}  // namespace radfarm
