#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "effects/specialise.h"
#include "estimate/seen_discs.h"
#include "frame/view.h"
#include "pipeline/pipeline.h"
#include "radiosity/element_mesh.h"
#include "scene/world.h"
#include "senders/sender_grid.h"
#include "senders/reflector_lookup.h"

namespace radfarm {

/// A view by one light, ready for tiles: by all emitters, or by those of a light group. Neither copied nor moved.
struct LitView {
  /// By all emitters of `all`, or by some: then in a world of its own that borrows the rest of it.
  LitView(View opened, const World& all, std::optional<Shining> some, SenderTree sending)
      : view(std::move(opened)), tree(std::move(sending)), world(some ? own.emplace(all, std::move(*some)) : all) {}
  LitView(const LitView&) = delete;
  LitView& operator=(const LitView&) = delete;

  const View view;
  const SenderTree tree;              // empty unless the integrator gathers
  std::optional<World> own;
  const World& world;                 // without the effects that are off
  std::optional<ReflectorLookup> lookup;
  std::optional<SenderGrid> senders;
  std::optional<ElementMesh> mesh;    // of the integrator radiosity
  std::optional<SideNumbers> sides;   // with it

  /// Where photon tasks count paths, or the photons that these leave: made when one first asks.
  struct Photons {
    Photons(const LitView& lit, const Film& film);
    const Components components;
    const SeenDiscs seen;
    std::optional<DiscSet> set;  // for paths
  };
  const Photons& photons(const Film& film) const;
  mutable std::once_flag has_photons;
  mutable std::optional<Photons> seen_photons;

  bool has_interreflection() const { return !contains(view.settings.effects_off, Effect::kInterreflection); }
  bool is_paper() const { return senders && view.settings.senders.gather == Gather::kPaper; }
};

/// What a Prepared holds; known to this module only.
struct Prepared::Parts {
  Parts(const Settings& common, Scene loaded)
      : settings(common),
        world(is_exact() ? specialise(std::move(loaded), settings.effects_off) : specialise(loaded, settings.effects_off)),
        scene(is_exact() ? Scene() : std::move(loaded)) {}
  const Settings settings;            // of the first view: what tasks and audit need is common to all
  const World world;                  // without the effects that are off
  std::vector<std::unique_ptr<const LitView>> lit;  // one, or one a light group

  bool is_exact() const { return settings.effects_off == settings.exactly_off; }
  /// With all effects but those that change nothing: made when an audit task first asks; the same world where it can be.
  const World& audited() const;

  const Scene scene;                  // as loaded; empty where `world` is all that is needed
  mutable std::once_flag is_audited;
  mutable std::optional<World> audit_world;
};

}  // namespace radfarm
