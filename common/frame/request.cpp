#include "frame/request.h"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace radfarm {
namespace {

using Json = nlohmann::json;
using Integrator = RenderRequest::Integrator;
using Quality = RenderRequest::Quality;
using UpAxis = RenderRequest::UpAxis;
using NamedCamera = RenderRequest::NamedCamera;
using PlacedCamera = RenderRequest::PlacedCamera;

template <typename T>
struct Name {
  T value;
  const char* text;
};
constexpr std::array kIntegrators = {
    Name<Integrator>{Integrator::kAuto, "auto"},
    Name<Integrator>{Integrator::kRadiosity, "radiosity"},
    Name<Integrator>{Integrator::kGather, "gather"},
    Name<Integrator>{Integrator::kFullGather, "full-gather"},
    Name<Integrator>{Integrator::kPathTrace, "path-trace"},
    Name<Integrator>{Integrator::kPaths, "paths"},
    Name<Integrator>{Integrator::kPhotonMap, "photon-map"},
};
constexpr std::array kQualities = {
    Name<Quality>{Quality::kPreview, "preview"},
    Name<Quality>{Quality::kStandard, "standard"},
    Name<Quality>{Quality::kHigh, "high"},
    Name<Quality>{Quality::kReference, "reference"},
};
constexpr std::array kOracles = {Name<Oracle>{Oracle::kKs, "KS"}, Name<Oracle>{Oracle::kKl, "KL"}, Name<Oracle>{Oracle::kCs, "CS"},
                                 Name<Oracle>{Oracle::kHe, "HE"}, Name<Oracle>{Oracle::kVar, "VAR"}};
constexpr std::array kGathers = {Name<Gather>{Gather::kDefault, "default"}, Name<Gather>{Gather::kPaper, "paper"}};
constexpr std::array kUpAxes = {Name<UpAxis>{UpAxis::kY, "Y"}, Name<UpAxis>{UpAxis::kZ, "Z"}};

template <typename T, std::size_t N>
std::string name_of(const std::array<Name<T>, N>& names, T value) {
  for (const Name<T>& name : names) {
    if (name.value == value) return name.text;
  }
  return "";
}

template <typename T, std::size_t N>
Result<T> value_of(const std::array<Name<T>, N>& names, std::string_view what, std::string_view text) {
  std::string all;
  for (const Name<T>& name : names) {
    if (text == name.text) return name.value;
    all += (all.empty() ? "" : ", ") + std::string(name.text);
  }
  return fail(Code::kInvalidArgument, std::string(what) + ": '" + std::string(text) + "' is not one of " + all);
}

tl::unexpected<Error> invalid(std::string message) { return fail(Code::kInvalidArgument, std::move(message)); }

Json to_json(const Vec3d& v) { return Json::array({v.x, v.y, v.z}); }

Json to_json(const NamedCamera& camera) { return {{"name", camera.name_or_index}}; }

Json to_json(const PlacedCamera& camera) {
  return {{"eye", to_json(camera.eye)},
          {"look_at", to_json(camera.look_at)},
          {"up_vector", to_json(camera.up_vector)},
          {"vertical_fov_degrees", camera.vertical_fov_degrees},
          {"orthographic_height", camera.orthographic_height ? Json(*camera.orthographic_height) : Json()}};
}

Status wrong_type(std::string_view key, std::string_view expected) {
  return invalid(std::string(key) + ": must be " + std::string(expected));
}

Status read(const Json& json, std::string_view key, std::string& out) {
  if (!json.is_string()) return wrong_type(key, "a string");
  out = json.get<std::string>();
  return {};
}

Status read(const Json& json, std::string_view key, bool& out) {
  if (!json.is_boolean()) return wrong_type(key, "true or false");
  out = json.get<bool>();
  return {};
}

Status read(const Json& json, std::string_view key, std::uint64_t& out) {
  const bool fits = json.is_number_unsigned() || (json.is_number_integer() && json.get<std::int64_t>() >= 0);
  if (!fits) return wrong_type(key, "a whole number from 0 to 18446744073709551615");
  out = json.get<std::uint64_t>();
  return {};
}

Status read(const Json& json, std::string_view key, int& out) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= static_cast<std::uint64_t>(kMost)
                                              : json.is_number_integer() && json.get<std::int64_t>() >= -kMost;
  if (!fits) return wrong_type(key, "a whole number");
  out = json.get<int>();
  return {};
}

Status read(const Json& json, std::string_view key, double& out) {
  if (!json.is_number()) return wrong_type(key, "a number");
  out = json.get<double>();
  return {};
}

Status read(const Json& json, std::string_view key, float& out) {
  double value = 0;
  RADFARM_TRY_STATUS(read(json, key, value));
  if (!(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    return wrong_type(key, "a number that a float can hold");
  }
  out = static_cast<float>(value);
  return {};
}

Status read(const Json& json, std::string_view key, Vec3d& out) {
  if (!json.is_array() || json.size() != 3) return wrong_type(key, "three numbers");
  RADFARM_TRY_STATUS(read(json[0], key, out.x));
  RADFARM_TRY_STATUS(read(json[1], key, out.y));
  return read(json[2], key, out.z);
}

Status read(const Json& json, std::string_view key, std::vector<std::string>& out) {
  if (!json.is_array()) return wrong_type(key, "an array of names");
  for (const Json& name : json) RADFARM_TRY_STATUS(read(name, key, out.emplace_back()));
  return {};
}

Status read(const Json& json, std::string_view key, Integrator& out) {
  std::string text;
  RADFARM_TRY_STATUS(read(json, key, text));
  RADFARM_TRY(out, integrator_from_string(text));
  return {};
}

Status read(const Json& json, std::string_view key, Quality& out) {
  std::string text;
  RADFARM_TRY_STATUS(read(json, key, text));
  RADFARM_TRY(out, quality_from_string(text));
  return {};
}

Status read(const Json& json, std::string_view key, Gather& out) {
  std::string text;
  RADFARM_TRY_STATUS(read(json, key, text));
  RADFARM_TRY(out, gather_from_string(text));
  return {};
}

Status read(const Json& json, std::string_view key, Oracle& out) {
  std::string text;
  RADFARM_TRY_STATUS(read(json, key, text));
  RADFARM_TRY(out, oracle_from_string(text));
  return {};
}

Status read(const Json& json, std::string_view key, UpAxis& out) {
  std::string text;
  RADFARM_TRY_STATUS(read(json, key, text));
  RADFARM_TRY(out, value_of(kUpAxes, key, text));
  return {};
}

template <typename T>
Status read(const Json& json, std::string_view key, std::optional<T>& out) {
  T value{};
  RADFARM_TRY_STATUS(read(json, key, value));
  out = value;
  return {};
}

Status read(const Json& json, std::string_view key, std::map<std::string, std::string>& out) {
  if (!json.is_object()) return wrong_type(key, "an object of light names and files");
  for (const auto& [name, value] : json.items()) {
    RADFARM_TRY_STATUS(read(value, std::string(key) + "." + name, out[name]));
  }
  return {};
}

Status unknown_key(std::string_view key) { return invalid("unknown key '" + std::string(key.substr(0, 80)) + "'"); }

Status read(const Json& json, std::string_view key, std::variant<NamedCamera, PlacedCamera>& out) {
  if (!json.is_object()) return wrong_type(key, "an object with name, or with eye and look_at");
  NamedCamera named;
  PlacedCamera placed;
  for (const auto& [name, value] : json.items()) {
    const std::string path = "camera." + name;
    if (name == "name") RADFARM_TRY_STATUS(read(value, path, named.name_or_index));
    else if (name == "eye") RADFARM_TRY_STATUS(read(value, path, placed.eye));
    else if (name == "look_at") RADFARM_TRY_STATUS(read(value, path, placed.look_at));
    else if (name == "up_vector") RADFARM_TRY_STATUS(read(value, path, placed.up_vector));
    else if (name == "vertical_fov_degrees") RADFARM_TRY_STATUS(read(value, path, placed.vertical_fov_degrees));
    else if (name == "orthographic_height" && value.is_null()) continue;
    else if (name == "orthographic_height") RADFARM_TRY_STATUS(read(value, path, placed.orthographic_height));
    else return unknown_key(path);
  }
  const bool is_named = json.contains("name") || json.empty();
  if (is_named && json.size() > 1) return invalid("camera: has a name and a placement, must have one of them");
  if (!is_named && !(json.contains("eye") && json.contains("look_at"))) {
    return invalid("camera: a placed camera needs eye and look_at");
  }
  if (is_named) out = std::move(named);
  else out = placed;
  return {};
}

Status read_member(const std::string& key, const Json& value, RenderRequest& request) {
  if (key == "integrator") return read(value, key, request.integrator);
  if (key == "gather") return read(value, key, request.gather);
  if (key == "quality") return read(value, key, request.quality);
  if (key == "camera") return read(value, key, request.camera);
  if (key == "width") return read(value, key, request.width);
  if (key == "height") return read(value, key, request.height);
  if (key == "up") return read(value, key, request.up);
  if (key == "seed") return read(value, key, request.seed);
  if (key == "tile") return read(value, key, request.tile);
  if (key == "samples") return read(value, key, request.samples);
  if (key == "photons") return read(value, key, request.photons);
  if (key == "radius") return read(value, key, request.radius);
  if (key == "link_error") return read(value, key, request.link_error);
  if (key == "threshold") return read(value, key, request.threshold);
  if (key == "oracle") return read(value, key, request.oracle);
  if (key == "error") return read(value, key, request.error);
  if (key == "time") return read(value, key, request.time);
  if (key == "audit") return read(value, key, request.audit);
  if (key == "sharing") return read(value, key, request.sharing);
  if (key == "mesh") return read(value, key, request.mesh);
  if (key == "aov") return read(value, key, request.aov);
  if (key == "effects") return read(value, key, request.effects);
  if (key == "env") return read(value, key, request.env);
  if (key == "ies") return read(value, key, request.ies);
  if (key == "lens_diameter") return read(value, key, request.lens_diameter);
  if (key == "focus_distance") return read(value, key, request.focus_distance);
  return unknown_key(key);
}

}  // namespace

nlohmann::json to_json(const RenderRequest& request) {
  Json json = {{"integrator", to_string(request.integrator)},
               {"up", name_of(kUpAxes, request.up)},
               {"seed", request.seed},
               {"tile", request.tile},
               {"oracle", to_string(request.oracle)},
               {"audit", request.audit},
               {"sharing", request.sharing},
               {"effects", request.effects},
               {"env", request.env}};
  if (!request.error && !request.time) json["quality"] = to_string(request.quality);
  if (request.gather != Gather::kDefault) json["gather"] = to_string(request.gather);
  if (request.mesh) json["mesh"] = true;
  if (!request.aov.empty()) json["aov"] = request.aov;
  if (!request.ies.empty()) json["ies"] = request.ies;
  if (request.lens_diameter) json["lens_diameter"] = *request.lens_diameter;
  if (request.focus_distance) json["focus_distance"] = *request.focus_distance;
  json["camera"] = std::visit([](const auto& camera) { return to_json(camera); }, request.camera);
  if (request.width) json["width"] = *request.width;
  if (request.height) json["height"] = *request.height;
  if (request.error) json["error"] = *request.error;
  if (request.time) json["time"] = *request.time;
  if (request.samples) json["samples"] = *request.samples;
  if (request.photons) json["photons"] = *request.photons;
  if (request.radius) json["radius"] = *request.radius;
  if (request.link_error) json["link_error"] = *request.link_error;
  if (request.threshold) json["threshold"] = *request.threshold;
  return json;
}

Result<RenderRequest> render_request_from_json(const nlohmann::json& json) {
  if (!json.is_object()) return invalid("a render request must be a JSON object");
  RenderRequest request;
  for (const auto& [key, value] : json.items()) RADFARM_TRY_STATUS(read_member(key, value, request));
  const auto asked = json.count("quality") + json.count("error") + json.count("time");
  if (asked > 1) return invalid("quality, error and time exclude each other");
  return request;
}

std::string to_string(Integrator integrator) { return name_of(kIntegrators, integrator); }

Result<Integrator> integrator_from_string(std::string_view name) { return value_of(kIntegrators, "integrator", name); }

std::string to_string(Quality quality) { return name_of(kQualities, quality); }

Result<Quality> quality_from_string(std::string_view name) { return value_of(kQualities, "quality", name); }

std::string to_string(Gather gather) { return name_of(kGathers, gather); }

Result<Gather> gather_from_string(std::string_view name) { return value_of(kGathers, "gather", name); }

std::string to_string(Oracle oracle) { return name_of(kOracles, oracle); }

Result<Oracle> oracle_from_string(std::string_view name) { return value_of(kOracles, "oracle", name); }

}  // namespace radfarm
