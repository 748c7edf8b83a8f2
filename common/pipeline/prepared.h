#pragma once

#include <optional>

#include "frame/view.h"
#include "pipeline/pipeline.h"
#include "scene/world.h"
#include "senders/sender_grid.h"
#include "senders/sender_lookup.h"

namespace radfarm {

/// What a Prepared holds; known to this module only.
struct Prepared::Parts {
  Parts(View opened, Scene scene, SenderTree sending)
      : view(std::move(opened)), world(std::move(scene)), tree(std::move(sending)) {}
  const View view;
  const World world;
  const SenderTree tree;              // empty unless the integrator gathers
  std::optional<SenderLookup> lookup;
  std::optional<SenderGrid> senders;
  bool has_interreflection = true;
};

}  // namespace radfarm
