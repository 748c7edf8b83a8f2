#include "scene/recentre.h"

#include <algorithm>
#include <cmath>

#include "scene/surface_samples.h"

namespace radfarm {
namespace {

/// The scene's middle, on a grid.
Vec3d choose_origin(const SurfaceSamples& samples) {
  double spread = 0;
  Vec3d origin(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = samples.quantile(axis, 0.5);
    spread = std::max(spread, samples.quantile(axis, 0.9) - samples.quantile(axis, 0.1));
  }
  if (!(spread > 0)) return origin;
  const double step = std::exp2(std::floor(std::log2(spread)) - 4);
  for (int axis = 0; axis < 3; ++axis) origin[axis] = std::round(origin[axis] / step) * step + 0.0;  // no -0
  return origin;
}

/// Where a mesh of float coordinates has its own middle, if that is so far out that transforming it would lose digits.
Vec3d own_centre(const std::vector<Vec3>& positions) {
  Imath::Box3d box;
  for (const Vec3& p : positions) box.extendBy(to_double(p));
  if (box.isEmpty()) return Vec3d(0.0);
  constexpr double kFar = 16;
  const Vec3d size = box.size();
  const Vec3d centre = box.center();
  return length(centre) > kFar * length(size) && length(size) > 0 ? centre : Vec3d(0.0);
}

Matrix4d translation(const Vec3d& by) {
  Matrix4d matrix;
  matrix.setTranslation(by);
  return matrix;
}

}  // namespace

Scene recentre(DraftScene draft) {
  Scene& scene = draft.scene;
  scene.origin = choose_origin(sample_surfaces(draft));

  // Each mesh gives up its middle (doubles: the origin itself), which its instances take over.
  std::vector<Vec3d> middles(scene.meshes.size(), Vec3d(0.0));
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    std::vector<Vec3>& positions = scene.meshes[m].positions;
    if (!draft.positions[m].empty()) {
      middles[m] = scene.origin;
      positions.clear();
      for (const Vec3d& p : draft.positions[m]) positions.push_back(to_float(p - middles[m]));
      draft.positions[m] = {};
    } else if (middles[m] = own_centre(positions); length(middles[m]) > 0) {
      for (Vec3& p : positions) p = to_float(to_double(p) - middles[m]);
    }
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    Matrix4d world = translation(middles[scene.instances[i].mesh]) * draft.instance_to_world[i];
    for (unsigned axis = 0; axis < 3; ++axis) world[3][axis] -= scene.origin[static_cast<int>(axis)];
    scene.instances[i].to_world = Matrix4(world);
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    scene.lights[i].position = to_float(draft.light_positions[i] - scene.origin);
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    scene.cameras[i].position = to_float(draft.camera_positions[i] - scene.origin);
  }
  return std::move(draft.scene);
}

}  // namespace radfarm
