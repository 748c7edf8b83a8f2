#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "math/spectrum.h"

namespace radfarm {

/// Properties of checked glTF JSON, with the specification's default where one is missing (or of another type where
/// check_gltf() had no reason to look). None of these throws.

/// object[key] if that is an object, else an empty one.
const nlohmann::json& gltf_object(const nlohmann::json& object, const std::string& key);
/// object.extensions[name], or an empty object.
const nlohmann::json& gltf_extension(const nlohmann::json& object, const std::string& name);
bool has_gltf_extension(const nlohmann::json& object, const std::string& name);

double gltf_number(const nlohmann::json& object, const std::string& key, double otherwise);
double gltf_element(const nlohmann::json& object, const std::string& key, std::size_t index, double otherwise);
SpectrumD gltf_color(const nlohmann::json& object, const std::string& key, double otherwise);
std::string gltf_text(const nlohmann::json& object, const std::string& key);

}  // namespace radfarm
