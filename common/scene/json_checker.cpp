#include "scene/json_checker.h"

#include <cstdio>

namespace radfarm {
namespace {

std::string shown(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

/// A key as a JSON pointer spells it.
std::string escaped(const std::string& key) {
  std::string result;
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c >= ' ' ? c : '?';
    }
  }
  return result;
}

const nlohmann::json& empty_object() {
  static const nlohmann::json kEmpty = nlohmann::json::object();
  return kEmpty;
}

}  // namespace

JsonPlace JsonPlace::at(const std::string& key) const { return {&(*value)[key], pointer + "/" + escaped(key)}; }

JsonPlace JsonPlace::extension(const std::string& name) const {
  const std::string there = pointer + "/extensions/" + escaped(name);
  if (!has("extensions") || !at("extensions").has(name)) return {&empty_object(), there};
  const nlohmann::json& found = (*value)["extensions"][name];
  return {found.is_object() ? &found : &empty_object(), there};
}

void JsonChecker::fault(const std::string& pointer, const std::string& message, Code code) {
  if (ok()) status_ = fail(code, (pointer.empty() ? "/" : pointer) + ": " + message);
}

void JsonChecker::require(const JsonPlace& object, const std::string& key) {
  if (!object.has(key)) fault(object.pointer, "'" + key + "' is missing");
}

void JsonChecker::each_object(const JsonPlace& object, const std::string& key,
                              const std::function<void(const JsonPlace&)>& visit) {
  if (!ok() || !object.has(key)) return;
  const JsonPlace array = object.at(key);
  if (!array.value->is_array()) return fault(array.pointer, "must be an array");
  for (std::size_t i = 0; i < array.value->size() && ok(); ++i) {
    const JsonPlace element = array.at(i);
    if (!element.value->is_object()) return fault(element.pointer, "must be an object");
    visit(element);
  }
}

void JsonChecker::one_index(const JsonPlace& place, std::string_view kind, std::size_t count) {
  if (!place.value->is_number_unsigned()) return fault(place.pointer, "must be the index of a " + std::string(kind));
  const auto index = place.value->get<std::uint64_t>();
  if (index < count) return;
  fault(place.pointer, std::string(kind) + " " + std::to_string(index) + " does not exist (there are " +
                           std::to_string(count) + ")");
}

void JsonChecker::index(const JsonPlace& object, const std::string& key, std::string_view kind, std::size_t count) {
  if (ok() && object.has(key)) one_index(object.at(key), kind, count);
}

void JsonChecker::indices(const JsonPlace& object, const std::string& key, std::string_view kind, std::size_t count) {
  if (!ok() || !object.has(key)) return;
  const JsonPlace array = object.at(key);
  if (!array.value->is_array()) return fault(array.pointer, "must be an array of indices");
  for (std::size_t i = 0; i < array.value->size() && ok(); ++i) one_index(array.at(i), kind, count);
}

std::size_t JsonChecker::integer(const JsonPlace& object, const std::string& key, std::size_t missing,
                                 std::size_t lowest, std::size_t highest) {
  if (!ok() || !object.has(key)) return missing;
  const JsonPlace place = object.at(key);
  const bool is_whole = place.value->is_number_unsigned();
  if (is_whole) {
    const auto value = place.value->get<std::uint64_t>();
    if (value >= lowest && value <= highest) return value;
  }
  fault(place.pointer, "must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
  return missing;
}

void JsonChecker::one_number(const JsonPlace& place, NumberRange range) {
  if (!place.value->is_number()) return fault(place.pointer, "must be a number");
  const auto value = place.value->get<double>();
  if (value >= range.lowest && value <= range.highest) return;
  const bool has_top = range.highest < std::numeric_limits<double>::max();
  fault(place.pointer, "is " + shown(value) + ", must be " +
                           (has_top ? "in [" + shown(range.lowest) + ", " + shown(range.highest) + "]"
                                    : "finite and at least " + shown(range.lowest)));
}

void JsonChecker::number(const JsonPlace& object, const std::string& key, NumberRange range) {
  if (ok() && object.has(key)) one_number(object.at(key), range);
}

void JsonChecker::numbers(const JsonPlace& object, const std::string& key, std::size_t size, NumberRange range) {
  if (!ok() || !object.has(key)) return;
  const JsonPlace array = object.at(key);
  if (!array.value->is_array() || array.value->size() != size) {
    return fault(array.pointer, "must be an array of " + std::to_string(size) + " numbers");
  }
  for (std::size_t i = 0; i < size && ok(); ++i) one_number(array.at(i), range);
}

void JsonChecker::string(const JsonPlace& object, const std::string& key) {
  if (ok() && object.has(key) && !object.at(key).value->is_string()) {
    fault(object.at(key).pointer, "must be a string");
  }
}

}  // namespace radfarm
