#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/status.h"
#include "scene/json_checker.h"

namespace radfarm {

/// EXT_meshopt_compression: buffer views whose bytes meshoptimizer's codecs have packed.

/// Proves of one buffer view that its packed bytes lie inside their buffer, that codec, filter, stride and count go
/// together, and that it unpacks to what the view declares, by no more than the codecs can.
void check_gltf_meshopt(JsonChecker& checker, const JsonPlace& root, const JsonPlace& view);

/// Whether the buffer only stands for unpacked bytes and may be without data.
bool is_meshopt_fallback(const nlohmann::json& buffer);

/// Unpacks every packed view into a buffer of its own, appended to `buffers`, and points the view in `document` there.
/// Views that are left without bytes (of a fallback buffer, unpacked) are errors. Requires: a document that
/// check_gltf() has passed, and its buffers. RESOURCE_EXHAUSTED above limits::kUnpackedBytes.
Status unpack_gltf_meshopt(nlohmann::json& document, std::vector<std::string>& buffers);

}  // namespace radfarm
