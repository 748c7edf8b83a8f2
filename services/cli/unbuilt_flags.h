#pragma once

#include <string>

#include "base/status.h"

namespace radfarm::cli {

/// UNIMPLEMENTED when `value` is one that the contract (DESIGN section 9) names for `flag` and that does not exist yet: giving
/// one is answered with what works today.
Status check_built(const std::string& flag, const std::string& value);

}  // namespace radfarm::cli
