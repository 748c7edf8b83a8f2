#pragma once

#include <string_view>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// The environment that `--env sky:...` asks for; `parameters` is what follows "sky:", comma-separated. docs/sky.md
/// lists them. The map is 512 x 256, neutral in colour, and gives the ground exactly the sky's illuminance; below the
/// horizon it is the ground's uniform radiance. INVALID_ARGUMENT names the parameter that is wrong; FAILED_PRECONDITION
/// when nothing shines.
Result<Environment> make_sky(std::string_view parameters);

}  // namespace radfarm
