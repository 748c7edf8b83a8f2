#pragma once

#include "base/progress.h"
#include "pipeline/solution_store.h"
#include "scene/world.h"

namespace radfarm {

/// The light of a world, and whether it was found in the store.
struct ObtainedLight {
  SolvedLight light;
  bool is_reused = false;
};

/// Which light of a world is wanted: all that decides its bits besides the scene.
struct WantedLight {
  RadiositySettings settings;
  std::uint64_t seed = 1;
  bool is_reflecting = true;  // whether interreflection is solved; without, the emitters alone send
  LightForm form = LightForm::kSenders;
};

/// Taken from `store` where it is there, else solved and kept. The same bytes either way. CANCELLED, and nothing is kept, when
/// `progress` is.
Result<ObtainedLight> obtain_light(const World& world, const WantedLight& wanted, const SolutionStore& store,
                                   const Progress& progress);

}  // namespace radfarm
