#pragma once

#include <string>
#include <vector>

#include "base/status.h"
#include "estimate/aov.h"
#include "frame/request.h"

namespace radfarm {

/// "samples.camera": the name of a layer on request, in flags, requests, EXR layers and files.
std::string to_string(Aov aov);
/// In the order of the enum.
std::vector<std::string> aov_names(AovSet set);

/// The AOVs that a request names; "all" is all that its integrator gives. INVALID_ARGUMENT lists the names there are when one is
/// unknown, and what the integrator gives when it does not give one; UNIMPLEMENTED where the contract has one that is not built.
Result<AovSet> requested_aovs(const RenderRequest& request);

/// The name that asks for light groups, layers light.NAME (frame/light_layers.h): no AOV of its own, as each group is an image of
/// its own, and no part of "all", as it costs as much.
inline constexpr const char* kLightGroups = "light";
bool wants_light_groups(const RenderRequest& request);

}  // namespace radfarm
