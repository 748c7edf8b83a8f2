#include "scene/opening.h"

#include <array>

namespace radfarm {
namespace {

constexpr double kNear = 0.05;    // of the box's extent: how far from a face its wall may stand
constexpr double kFacing = 0.5;   // cosine between a wall's normal and its face's
constexpr double kOpen = 0.1;     // share of a face that is covered: below, one can look in ...
constexpr double kClosed = 0.5;   // ... and above, there is a wall to look at

/// Calls visit(triangle's vertices in the world, front).
template <typename Visit>
void for_each_triangle(const Scene& scene, const Visit& visit) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const Matrix4d to_world(instance.to_world);
    const double front = to_world.determinant() < 0 ? -1 : 1;
    for (const auto& t : mesh.triangles) {
      visit(std::array{to_double(mesh.positions[t[0]]) * to_world, to_double(mesh.positions[t[1]]) * to_world,
                       to_double(mesh.positions[t[2]]) * to_world},
            front);
    }
  }
}

Vec3d centroid(const std::array<Vec3d, 3>& t) { return (t[0] + t[1] + t[2]) / 3.0; }

/// Centroids of large triangles lie well inside the room that they span, so the box is that of their corners.
Imath::Box3d box_of_triangles(const Scene& scene, const Imath::Box3d& bulk) {
  Imath::Box3d box;
  for_each_triangle(scene, [&](const std::array<Vec3d, 3>& t, double) {
    if (!bulk.intersects(centroid(t))) return;
    for (const Vec3d& corner : t) box.extendBy(corner);
  });
  return box;
}

/// Per axis, low side and high side: the share of the box's face that surfaces near it cover which face the room.
using Covered = std::array<std::array<double, 2>, 3>;

Covered cover(const Scene& scene, const Imath::Box3d& box) {
  Covered covered{};
  const Vec3d size = box.size();
  for_each_triangle(scene, [&](const std::array<Vec3d, 3>& t, double front) {
    const Vec3d middle = centroid(t);
    if (!box.intersects(middle)) return;
    const Vec3d area = cross(t[1] - t[0], t[2] - t[0]) * (front / 2);
    for (int axis = 0; axis < 3; ++axis) {
      const double face = size[(axis + 1) % 3] * size[(axis + 2) % 3];
      const double near = kNear * size[axis];
      const double facing = kFacing * length(area);
      const auto a = static_cast<std::size_t>(axis);
      if (middle[axis] - box.min[axis] < near && area[axis] > facing) covered[a][0] += area[axis] / face;
      if (box.max[axis] - middle[axis] < near && -area[axis] > facing) covered[a][1] -= area[axis] / face;
    }
  });
  return covered;
}

Opening opening_at(const Imath::Box3d& box, int axis, int side) {
  Opening opening;
  opening.centre = box.center();
  opening.centre[axis] = side == 0 ? box.min[axis] : box.max[axis];
  opening.outwards = Vec3d(0.0);
  opening.outwards[axis] = side == 0 ? -1 : 1;
  opening.half_width = box.size()[2 - axis] / 2;
  opening.half_height = box.size().y / 2;
  return opening;
}

}  // namespace

std::optional<Opening> find_opening(const Scene& scene, const Imath::Box3d& bulk) {
  const Imath::Box3d box = box_of_triangles(scene, bulk);
  if (!box.hasVolume()) return std::nullopt;
  const Covered covered = cover(scene, box);
  std::optional<Opening> opening;
  double least = kOpen;
  // Along z before x: a box open in front and at a side is seen from the front.
  for (const int axis : {2, 0}) {
    for (const int side : {1, 0}) {
      const auto& [low, high] = covered[static_cast<std::size_t>(axis)];
      const double here = side == 0 ? low : high;
      const double opposite = side == 0 ? high : low;
      if (here >= least || opposite <= kClosed) continue;
      least = here;
      opening = opening_at(box, axis, side);
    }
  }
  return opening;
}

}  // namespace radfarm
