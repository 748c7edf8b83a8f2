#pragma once

#include "frame/view.h"
#include "pipeline/pipeline.h"
#include "scene/world.h"

namespace radfarm {

/// What a Prepared holds; known to this module only.
struct Prepared::Parts {
  Parts(View opened, Scene scene) : view(std::move(opened)), world(std::move(scene)) {}
  const View view;
  const World world;
};

}  // namespace radfarm
