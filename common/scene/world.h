#pragma once

#include "scene/emitters.h"
#include "scene/environment_light.h"
#include "scene/ray_caster.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace radfarm {

/// A scene made ready for rays: what every later stage borrows. Neither copied nor moved: its parts refer to each other.
struct World {
  explicit World(Scene loaded);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Scene scene;
  const Surfaces surfaces;
  const RayCaster caster;
  const Box3 bounds;   // of all instances
  const float radius;  // of a sphere around the origin that holds them
  const EnvironmentLight environment;
  const Emitters emitters;
};

}  // namespace radfarm
