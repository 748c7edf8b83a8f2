#pragma once

#include <cstdint>

#include "radiosity/oracles.h"

namespace radfarm {

/// What steers the radiosity solve. Enters the solution's key: nothing camera-dependent may stand here.
struct RadiositySettings {
  float max_link_error = 2e-4F;        // largest accepted reflected power that a link may misplace, share of emitted flux
  float min_patch_area = 1e-5F;        // patches are not cut below this share of the scene's area
  float residual = 1e-3F;              // solve until an iteration changes the reflected power by less than this share
  std::uint32_t samples_per_link = 10; // random lines between the two elements of a link
  std::uint32_t max_links = 3'000'000;
  std::uint32_t max_passes = 3;        // refine with the current radiosity, solve again
  std::uint32_t direct_samples = 4;    // of emitters, least on one patch; as many rays
  std::uint32_t hits_per_patch = 4;   // of light paths, on average; 0: the links' solution stands alone
  LinkOracle oracle;                   // what judges a link; the literal forms give max_link_error other units
};

}  // namespace radfarm
