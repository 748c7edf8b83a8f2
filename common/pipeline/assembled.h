#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "frame/view.h"
#include "pipeline/pipeline.h"

namespace radfarm {

/// What an AssembledRound holds; known to this module only.
struct AssembledRound::Parts {
  std::vector<View> views;  // without their grids
  nlohmann::json facts;     // of the views, and what assembling found
  Raster raster;            // all light
  Image layers;             // of light groups
  Counters counters;
  RoundFigures figures;
};

}  // namespace radfarm
