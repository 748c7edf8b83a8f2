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

struct World::Geometry {
  explicit Geometry(Scene loaded) : scene(std::move(loaded)), surfaces(scene), caster(surfaces) {}
  const Scene scene;
  const Surfaces surfaces;
  const RayCaster caster;
};

World::World(Scene loaded)
    : own_(std::make_unique<const Geometry>(std::move(loaded))),
      scene(own_->scene),
      surfaces(own_->surfaces),
      caster(own_->caster),
      bounds(find_bounds(surfaces)),
      radius(radius_about_origin(bounds)),
      environment(scene.environment),
      emitters(find_emitters(surfaces, environment, radius, shining)) {}

World::World(const World& all, Shining some)
    : scene(all.scene),
      surfaces(all.surfaces),
      caster(all.caster),
      bounds(all.bounds),
      radius(all.radius),
      shining(std::move(some)),
      environment(shining.environment ? scene.environment : dark_),
      emitters(find_emitters(surfaces, environment, radius, shining)) {}

World::~World() = default;

}  // namespace radfarm
