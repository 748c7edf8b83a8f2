#pragma once

#include <span>

#include "scene/world.h"

namespace radfarm {

/// The light that a solve starts from: what the world's emitters send, and what specular paths bring. docs/pipeline.md (radiosity.5)
struct FirstLight {
  FirstLight(const World& emitters_of, std::span<const Spectrum> brought = {}) : world(emitters_of), specular(brought) {}
  const World& world;
  std::span<const Spectrum> specular;  // E_spec, lux, finite and >= 0: one a triangle side (SideNumbers), or none at all
};

}  // namespace radfarm
