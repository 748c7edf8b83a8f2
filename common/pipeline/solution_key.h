#pragma once

#include <cstdint>
#include <string>

#include "pipeline/solution_store.h"
#include "radiosity/settings.h"
#include "scene/scene.h"
#include "scene/shining.h"

namespace radfarm {

/// The name under which a radiosity solution is kept: SHA-256 over all that decides its bits, and nothing else. No camera, image
/// size, sample count or integrator enters, so one solution serves all of those. `scene` is the one that is solved, without
/// the effects that are off; `is_reflecting`: whether interreflection is solved at all; `shining`: by which of its emitters.
/// Cost: copies, encodes and hashes the scene.
std::string solution_key(const Scene& scene, const RadiositySettings& settings, std::uint64_t seed, bool is_reflecting,
                         LightForm form, const Shining& shining = {});

}  // namespace radfarm
