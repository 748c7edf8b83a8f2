#include "scene/gltf_values.h"

namespace radfarm {

const nlohmann::json& gltf_object(const nlohmann::json& object, const std::string& key) {
  static const nlohmann::json kEmpty = nlohmann::json::object();
  if (!object.is_object()) return kEmpty;
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : kEmpty;
}

const nlohmann::json& gltf_extension(const nlohmann::json& object, const std::string& name) {
  return gltf_object(gltf_object(object, "extensions"), name);
}

bool has_gltf_extension(const nlohmann::json& object, const std::string& name) {
  return gltf_object(object, "extensions").contains(name);
}

double gltf_number(const nlohmann::json& object, const std::string& key, double otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : otherwise;
}

double gltf_element(const nlohmann::json& object, const std::string& key, std::size_t index, double otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || index >= found->size()) return otherwise;
  return (*found)[index].is_number() ? (*found)[index].get<double>() : otherwise;
}

SpectrumD gltf_color(const nlohmann::json& object, const std::string& key, double otherwise) {
  return {gltf_element(object, key, 0, otherwise), gltf_element(object, key, 1, otherwise),
          gltf_element(object, key, 2, otherwise)};
}

std::string gltf_text(const nlohmann::json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace radfarm
