#pragma once

#include <memory>

#include "scene/emitters.h"
#include "scene/environment_light.h"
#include "scene/ray_caster.h"
#include "scene/scene.h"
#include "scene/shining.h"
#include "scene/surface.h"

namespace radfarm {

/// A scene made ready for rays: what every later stage borrows. Neither copied nor moved: its parts refer to each other.
class World {
 public:
  explicit World(Scene loaded);
  /// The same surfaces where only some of the emitters shine. Borrows `all`, its rays and textures too: it must outlive this
  /// world. Cost: O(emissive triangles + sky texels).
  World(const World& all, Shining some);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  /// Radiance emitted from the side that `point` shows, cd/m^2; black where the surface emits but does not shine in this world.
  Spectrum emission(const SurfacePoint& point) const {
    return shining.material(point.material) ? surfaces.emission(point) : Spectrum();
  }

 private:
  struct Geometry;
  const std::unique_ptr<const Geometry> own_;  // none: another world's is borrowed
  const Environment dark_;

 public:
  const Scene& scene;
  const Surfaces& surfaces;
  const RayCaster& caster;
  const Box3 bounds;   // of all instances
  const float radius;  // of a sphere around the origin that holds them
  const Shining shining;
  const EnvironmentLight environment;
  const Emitters emitters;
};

}  // namespace radfarm
