#include "senders/patch_mesh.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace radfarm {
namespace {

constexpr float kLeastCosine = 0.9848F;  // of 10 degrees: faces that belong to one smooth surface

Vec3 normal_of(const TriangleVertices& v) { return normalize(cross(v[1] - v[0], v[2] - v[0])); }

/// A corner of a patch that is gathered on. Sorted, corners at one position stand together, in the order of the patches.
struct Corner {
  std::array<std::uint32_t, 3> place{};  // the position's bits
  std::uint32_t reflector = 0;
  std::uint32_t corner = 0;
  friend bool operator<(const Corner& a, const Corner& b) {
    return std::tie(a.place, a.reflector, a.corner) < std::tie(b.place, b.reflector, b.corner);
  }
};

std::array<std::uint32_t, 3> bits_of(const Vec3& p) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); };  // -0 is 0
  return {bits(p.x), bits(p.y), bits(p.z)};
}

std::vector<Corner> sorted_corners(const World& world, const SenderTree& tree, const PerspectiveGrid& grid) {
  std::vector<Corner> corners;
  for (std::uint32_t i = 0; i < tree.reflectors.size(); ++i) {
    if (!is_gathered_on(world, tree.reflectors[i], grid)) continue;
    for (std::uint32_t c = 0; c < 3; ++c) corners.push_back({bits_of(tree.reflectors[i].vertices[c]), i, c});
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Makes vertices of the corners at one position: each takes what is left that faces as its first patch does.
void join(const SenderTree& tree, std::span<const Corner> corners, PatchMesh& mesh) {
  for (const Corner& first : corners) {
    if (mesh.corners[first.reflector][first.corner] != kNone) continue;
    const std::uint32_t vertex = mesh.vertex_count();
    const Vec3 normal = normal_of(tree.reflectors[first.reflector].vertices);
    for (const Corner& other : corners) {
      std::uint32_t& place = mesh.corners[other.reflector][other.corner];
      if (place != kNone || dot(normal, normal_of(tree.reflectors[other.reflector].vertices)) < kLeastCosine) continue;
      place = vertex;
      mesh.reflectors_around.push_back(other.reflector);
    }
    mesh.first_around.push_back(static_cast<std::uint32_t>(mesh.reflectors_around.size()));
  }
}

}  // namespace

bool is_gathered_on(const World& world, const Reflector& patch, const PerspectiveGrid& grid) {
  const TriangleVertices& v = patch.vertices;
  // Parts have a quarter of the area at each level; half tells them from a whole despite rounding.
  const bool is_part = area_of(v) < area_of(world.surfaces.triangle(patch.instance, patch.triangle)) / 2;
  const float diameter = std::max({length(v[1] - v[0]), length(v[2] - v[1]), length(v[0] - v[2])});
  return is_part || diameter >= grid.mean_edge(grid.cell_at((v[0] + v[1] + v[2]) / 3.0F));
}

PatchMesh make_patch_mesh(const World& world, const SenderTree& tree, const PerspectiveGrid& grid) {
  PatchMesh mesh;
  mesh.corners.assign(tree.reflectors.size(), {kNone, kNone, kNone});
  mesh.first_around.push_back(0);
  const std::vector<Corner> corners = sorted_corners(world, tree, grid);
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && corners[end].place == corners[begin].place) ++end;
    join(tree, std::span(corners).subspan(begin, end - begin), mesh);
  }
  return mesh;
}

std::array<float, 3> corner_weights(const TriangleVertices& patch, const Vec3& position) {
  const Vec3d e1 = to_double(patch[1]) - to_double(patch[0]), e2 = to_double(patch[2]) - to_double(patch[0]);
  const Vec3d d = to_double(position) - to_double(patch[0]), normal = cross(e1, e2);
  const double area = dot(normal, normal);
  const double b = std::max(0.0, dot(cross(d, e2), normal) / area), c = std::max(0.0, dot(cross(e1, d), normal) / area);
  const double a = std::max(0.0, 1 - b - c), sum = a + b + c;
  return {static_cast<float>(a / sum), static_cast<float>(b / sum), static_cast<float>(c / sum)};
}

}  // namespace radfarm
