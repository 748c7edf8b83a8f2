#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bake/baked_scene.h"
#include "base/status.h"

namespace radfarm {

/// The baked scene as a glTF 2.0 binary for walk-throughs, in metres, Y up, where the source file had it.  docs/formats.md
///
/// Unlit materials (KHR_materials_unlit), light in COLOR_0, irradiance in lux in _IRRADIANCE, textures as embedded PNGs, the
/// source's cameras, one mesh an instance. `extras` becomes asset.extras, with the exposure and the units added.
Result<std::vector<std::byte>> encode_baked_glb(const BakedScene& baked, const World& world, const nlohmann::json& extras);

}  // namespace radfarm
