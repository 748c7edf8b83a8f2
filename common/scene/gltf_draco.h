#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/status.h"
#include "scene/json_checker.h"

namespace radfarm {

/// KHR_draco_mesh_compression: primitives whose indices and attributes Draco has packed into one buffer view.

bool has_draco(const nlohmann::json& primitive);

/// Proves of one primitive that its packed view exists and that its attribute ids are numbers.
void check_gltf_draco(JsonChecker& checker, const JsonPlace& root, const JsonPlace& primitive);

/// Unpacks every packed primitive into buffers appended to `buffers`, with views and accessors appended to `document`
/// that the primitive then names; one that another primitive names too stays as it was. Requires: a document that
/// check_gltf() has passed, and its buffers. The counts in the packed data are compared with the accessors' and with
/// limits.h before the decoder sees it.
Status unpack_gltf_draco(nlohmann::json& document, std::vector<std::string>& buffers);

}  // namespace radfarm
