#pragma once

#include <mutex>
#include <optional>

#include "effects/specialise.h"
#include "frame/view.h"
#include "pipeline/pipeline.h"
#include "radiosity/element_mesh.h"
#include "scene/world.h"
#include "senders/sender_grid.h"
#include "senders/reflector_lookup.h"

namespace radfarm {

/// What a Prepared holds; known to this module only.
struct Prepared::Parts {
  Parts(View opened, Scene loaded, SenderTree sending)
      : view(std::move(opened)),
        world(is_exact() ? specialise(std::move(loaded), view.settings.effects_off)
                         : specialise(loaded, view.settings.effects_off)),
        tree(std::move(sending)),
        scene(is_exact() ? Scene() : std::move(loaded)) {}
  const View view;
  const World world;                  // without the effects that are off
  const SenderTree tree;              // empty unless the integrator gathers
  std::optional<ReflectorLookup> lookup;
  std::optional<SenderGrid> senders;
  std::optional<ElementMesh> mesh;    // of the integrator radiosity
  std::optional<SideNumbers> sides;   // with it
  bool is_exact() const { return view.settings.effects_off == view.settings.exactly_off; }
  /// With all effects but those that change nothing: made when an audit task first asks; the same world where it can be.
  const World& audited() const;
  bool has_interreflection() const { return !contains(view.settings.effects_off, Effect::kInterreflection); }

  bool is_paper() const { return senders && view.settings.senders.gather == Gather::kPaper; }

  const Scene scene;                  // as loaded; empty where `world` is all that is needed
  mutable std::once_flag is_audited;
  mutable std::optional<World> audit_world;
};

}  // namespace radfarm
