#include "scene/world.h"

#include <algorithm>
#include <utility>

namespace radfarm {
namespace {

Box3 find_bounds(const Surfaces& surfaces) {
  Box3 bounds;
  const Scene& scene = surfaces.scene();
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const std::size_t triangles = scene.meshes[scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < triangles; ++t) {
      for (const Vec3& vertex : surfaces.triangle(i, t)) bounds.extendBy(vertex);
    }
  }
  return bounds;
}

float radius_about_origin(const Box3& bounds) {
  if (bounds.isEmpty()) return 1;
  const Vec3 reach(std::max(std::abs(bounds.min.x), std::abs(bounds.max.x)),
                   std::max(std::abs(bounds.min.y), std::abs(bounds.max.y)),
                   std::max(std::abs(bounds.min.z), std::abs(bounds.max.z)));
  return length(reach);
}

}  // namespace

World::World(Scene loaded)
    : scene(std::move(loaded)),
      surfaces(scene),
      caster(surfaces),
      bounds(find_bounds(surfaces)),
      radius(radius_about_origin(bounds)),
      environment(scene.environment),
      emitters(find_emitters(surfaces, environment, radius)) {}

}  // namespace radfarm
