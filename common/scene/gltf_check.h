#pragma once

#include <nlohmann/json.hpp>

#include "base/status.h"
#include "scene/json_checker.h"

namespace radfarm {

/// Proves of a glTF document what tinygltf takes on trust: every index exists, every view and accessor lies inside its
/// buffer, nodes form trees of bounded depth, factors, cameras and lights are in range, required extensions are
/// supported. An error is "JSON pointer: what is wrong". Does not look into buffers or images. Cost: O(JSON).
/// Loads with faults that change nothing we compute (min/max, targets, undeclared extensions): over-refusal helps
/// nobody.
Status check_gltf(const nlohmann::json& document);

/// The two halves of it: asset, buffers to meshes; and materials, nodes to scenes.
void check_gltf_data(JsonChecker& checker, const JsonPlace& root);
void check_gltf_scene(JsonChecker& checker, const JsonPlace& root);

/// How many elements the top-level array has; 0 when it is missing.
std::size_t count_of(const JsonPlace& root, const std::string& array);
/// Bytes of one component (glTF's number for its type), and components of an accessor type; 0 for unknown ones.
std::size_t component_bytes(std::size_t component_type);
std::size_t component_count(const std::string& type);

}  // namespace radfarm
