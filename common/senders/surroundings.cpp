#include "senders/surroundings.h"

#include <algorithm>

#include "base/random.h"
#include "math/sampling.h"
#include "senders/paper_vertex.h"

namespace radfarm {
namespace {

/// A point evenly over grid coordinates in one of the cells around a vertex.
Vec3 free_point(const PerspectiveGrid& grid, const std::vector<std::uint32_t>& cells, RandomSequence& random) {
  const std::uint32_t cell = cells[random.bits() % cells.size()];
  const std::uint32_t x = cell % grid.columns, y = cell / grid.columns % grid.rows, z = cell / grid.columns / grid.rows;
  const float dx = random.uniform(), dy = random.uniform(), dz = random.uniform();
  return grid.position({static_cast<float>(x) + dx, static_cast<float>(y) + dy, static_cast<float>(z) + dz});
}

/// On the side of the patch.
SurfacePoint point_of(const Surfaces& surfaces, const Reflector& patch, const Vec3& position) {
  SurfacePoint point = surfaces.at(surfaces.hit_at(patch.instance, patch.triangle, position));
  face(point, patch.is_front != 0 ? point.geometric_normal : -point.geometric_normal);
  return point;
}

/// A point evenly over one of the patches, off its side.
ReceiverPoint patch_point(const VertexContext& context, std::span<const std::uint32_t> patches, RandomSequence& random) {
  const Reflector& patch = context.tree.reflectors[patches[random.bits() % patches.size()]];
  const float u = random.uniform(), v = random.uniform();
  const Vec3 b = sample_uniform_triangle({u, v});
  const SurfacePoint point = point_of(context.world.surfaces, patch,
                                      patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z);
  return {leave(point), point.shading_normal, patch.reflectance};
}

}  // namespace

Surroundings around_grid_vertex(const VertexContext& context, std::uint32_t vertex) {
  return {region_around(context.grid, vertex), context.grid.cells_around(vertex), {}};
}

Surroundings around_patch_vertex(const VertexContext& context, std::uint32_t vertex) {
  const PatchMesh& mesh = context.paper->patches;
  const std::span<const std::uint32_t> patches = mesh.around(vertex);
  const auto& corners = mesh.corners[patches[0]];
  const auto corner = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
  ReceiverRegion region{context.tree.reflectors[patches[0]].vertices[corner], 0};
  for (const std::uint32_t id : patches) {
    for (const Vec3& v : context.tree.reflectors[id].vertices) region.radius = std::max(region.radius, length(v - region.center));
  }
  return {region, {}, patches};
}

ReceiverPoint random_receiver(const VertexContext& context, const Surroundings& around, std::uint64_t key) {
  RandomSequence random(key);
  if (around.is_on_surface()) return patch_point(context, around.patches, random);
  return {free_point(context.grid, around.cells, random), Vec3(0, 0, 0), 0};
}

std::vector<HalfSpace> half_spaces(const VertexContext& context, const Surroundings& around) {
  std::vector<HalfSpace> above;
  for (const std::uint32_t id : around.patches) {
    const Reflector& patch = context.tree.reflectors[id];
    const SurfacePoint point = point_of(context.world.surfaces, patch, patch.vertices[0]);
    above.push_back({point.geometric_normal, dot(point.geometric_normal, patch.vertices[0]) + point.offset});
  }
  return above;
}

bool is_below(const std::vector<HalfSpace>& half_spaces, const Box3& box) {
  const auto reaches = [&](const HalfSpace& space) {
    const Vec3& n = space.normal;
    const Vec3 top(n.x > 0 ? box.max.x : box.min.x, n.y > 0 ? box.max.y : box.min.y, n.z > 0 ? box.max.z : box.min.z);
    return dot(n, top) > space.height;
  };
  return !half_spaces.empty() && std::none_of(half_spaces.begin(), half_spaces.end(), reaches);
}

}  // namespace radfarm
