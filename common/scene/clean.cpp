#include "scene/clean.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "scene/draft_scene.h"
#include "scene/validate.h"

namespace radfarm {
namespace {

/// Removes degenerate triangles; how many.
std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [&](const auto& t) {
    return is_degenerate(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  });
}

/// Removes triangles whose corners are those of an earlier one, in whatever order: a ray meets one of two surfaces at one place,
/// but both would send light. How many.
std::size_t drop_doubled(Mesh& mesh) {
  using Corners = std::array<std::array<float, 3>, 3>;
  std::vector<std::pair<Corners, std::size_t>> sorted;
  sorted.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[mesh.triangles[i][k]];
      corners[k] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    sorted.emplace_back(corners, i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> is_doubled(mesh.triangles.size(), 0);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) is_doubled[sorted[i].second] = 1;
  }
  std::size_t next = 0;
  return std::erase_if(mesh.triangles, [&](const auto&) { return is_doubled[next++] != 0; });
}

/// Sums of the area vectors of the triangles about each vertex.
std::vector<Vec3d> surface_normals(const Mesh& mesh) {
  std::vector<Vec3d> normals(mesh.positions.size(), Vec3d(0.0));
  for (const auto& t : mesh.triangles) {
    const Vec3d a = to_double(mesh.positions[t[0]]);
    const Vec3d area = cross(to_double(mesh.positions[t[1]]) - a, to_double(mesh.positions[t[2]]) - a);
    for (const std::uint32_t vertex : t) normals[vertex] += area;
  }
  return normals;
}

/// Unit normals everywhere; how many had to be replaced.
std::size_t unify_normals(Mesh& mesh) {
  std::vector<Vec3d> replacements;
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vec3d normal = to_double(mesh.normals[i]);
    if (length(normal) > 1e-12) {
      mesh.normals[i] = to_float(normalize(normal));
      continue;
    }
    if (replacements.empty()) replacements = surface_normals(mesh);
    const bool has_surface = length(replacements[i]) > 0;
    mesh.normals[i] = has_surface ? to_float(normalize(replacements[i])) : Vec3(0, 1, 0);
    ++replaced;
  }
  return replaced;
}

/// Removes meshes that `keep` is false for, and renumbers the instances of the others.
void drop_meshes(Scene& scene, const std::vector<char>& keep) {
  std::vector<std::uint32_t> renumbered(scene.meshes.size(), kNone);
  std::vector<Mesh> meshes;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (keep[m] == 0) continue;
    renumbered[m] = static_cast<std::uint32_t>(meshes.size());
    meshes.push_back(std::move(scene.meshes[m]));
  }
  scene.meshes = std::move(meshes);
  for (Instance& instance : scene.instances) instance.mesh = renumbered[instance.mesh];
}

}  // namespace

bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3d e1 = to_double(b) - to_double(a);
  const Vec3d e2 = to_double(c) - to_double(a);
  const double longest = std::max({e1.length2(), e2.length2(), (e2 - e1).length2()});
  constexpr double kEpsilon = std::numeric_limits<float>::epsilon();
  return length(cross(e1, e2)) <= 4 * kEpsilon * longest;
}

void clean_scene(Scene& scene) {
  std::size_t degenerate = 0;
  std::size_t doubled = 0;
  std::size_t replaced = 0;
  std::vector<char> keep(scene.meshes.size(), 0);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    degenerate += drop_degenerate(scene.meshes[m]);
    doubled += drop_doubled(scene.meshes[m]);
    replaced += unify_normals(scene.meshes[m]);
    keep[m] = scene.meshes[m].triangles.empty() ? 0 : 1;
  }
  const std::size_t flattened = std::erase_if(scene.instances, [&](const Instance& instance) {
    return keep[instance.mesh] != 0 && !is_invertible(instance.to_world);
  });
  std::erase_if(scene.instances, [&](const Instance& instance) { return keep[instance.mesh] == 0; });
  drop_meshes(scene, keep);
  if (degenerate > 0) add_note(scene, std::to_string(degenerate) + " triangles without area are dropped.");
  if (doubled > 0) add_note(scene, std::to_string(doubled) + " triangles that lie exactly on others are dropped.");
  if (replaced > 0) add_note(scene, std::to_string(replaced) + " normals of zero length are taken from the surface.");
  if (flattened > 0) add_note(scene, std::to_string(flattened) + " instances of zero scale are dropped.");
}

}  // namespace radfarm
