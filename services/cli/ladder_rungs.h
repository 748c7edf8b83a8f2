#pragma once

#include <string>
#include <vector>

#include "base/status.h"
#include "frame/request.h"

namespace radfarm::cli {

/// One setting of a ladder.
struct Rung {
  std::string name;     // also that of its files: INTEGRATOR-QUALITY
  std::string curve;    // that it is a point of: its integrator
  RenderRequest request;
};

/// Every integrator with every quality, in their order; none is audited: the ladder measures against its reference. Lists are
/// separated by commas. INVALID_ARGUMENT for names that do not exist, and for what validate() says of a rung.
Result<std::vector<Rung>> make_rungs(const RenderRequest& base, const std::string& integrators, const std::string& qualities);

/// One of the two halves of a reference (0, 1): path tracing with so many samples and a seed of its own.
RenderRequest reference_half(const RenderRequest& base, int samples, int half);

}  // namespace radfarm::cli
