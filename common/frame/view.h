#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/status.h"
#include "estimate/settings.h"
#include "image/visibility_threshold.h"
#include "scene/scene.h"

namespace radfarm {

/// One prepared view by one light: what workers need besides scene and solution, and what the final report says of the stages
/// before.
struct View {
  Camera camera;             // name not stored
  Settings settings;
  std::string facts;         // JSON text: scene, effects, stages, counts and energy so far (docs/formats.md)
  std::vector<std::byte> grid;  // flat file of kind "grid"; empty when the integrator has none
  LuminanceImage elevation;     // of the visible threshold by detail, over the film, blocks of pixels each; empty without masking
  std::string light_group;      // EmitterGroup::name: what alone shines; empty: all emitters
};

/// Flat file of kind "view": one view, or one for each light group, of one film and integrator; the first one's facts are those
/// of all, the others have none. Hostile bytes give DATA_LOSS.
[[nodiscard]] std::vector<std::byte> encode(std::span<const View> views);
Result<std::vector<View>> decode_views(std::span<const std::byte> bytes);

}  // namespace radfarm
