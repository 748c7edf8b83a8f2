#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.h"

namespace radfarm {

/// What `radfarm info` prints: counts, bounds in the file's coordinates, areas, cameras, notes. Keys are part of the
/// command line's contract (docs/formats.md).
nlohmann::json summarize(const Scene& scene);

}  // namespace radfarm
