#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/status.h"

namespace radfarm {

/// A JSON value and the JSON pointer that leads to it.
struct JsonPlace {
  const nlohmann::json* value = nullptr;
  std::string pointer;

  bool has(const std::string& key) const { return value->is_object() && value->contains(key); }
  /// Requires: has(key).
  JsonPlace at(const std::string& key) const;
  JsonPlace at(std::size_t index) const { return {&(*value)[index], pointer + "/" + std::to_string(index)}; }
  /// The object below the keys, or an empty object where one is missing or of another type.
  JsonPlace extension(const std::string& name) const;
};

struct NumberRange {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
};

/// Tests values against what glTF allows and keeps the first fault, named by its JSON pointer. A missing optional
/// property is never a fault; a fault of a required one says so. All members are cheap once a fault is kept.
class JsonChecker {
 public:
  bool ok() const { return status_.has_value(); }
  const Status& status() const { return status_; }
  void fault(const std::string& pointer, const std::string& message, Code code = Code::kInvalidArgument);

  void require(const JsonPlace& object, const std::string& key);
  /// Calls visit for each element of the array of objects object[key], if there is one.
  void each_object(const JsonPlace& object, const std::string& key, const std::function<void(const JsonPlace&)>& visit);
  /// object[key] is an index below `count`: "accessor 12 does not exist (there are 9)".
  void index(const JsonPlace& object, const std::string& key, std::string_view kind, std::size_t count);
  /// object[key] is an array of such indices.
  void indices(const JsonPlace& object, const std::string& key, std::string_view kind, std::size_t count);
  /// A whole number in [lowest, highest]; `missing` when it is absent or faulty.
  std::size_t integer(const JsonPlace& object, const std::string& key, std::size_t missing, std::size_t lowest,
                      std::size_t highest);
  void number(const JsonPlace& object, const std::string& key, NumberRange range = {});
  /// An array of exactly `size` numbers.
  void numbers(const JsonPlace& object, const std::string& key, std::size_t size, NumberRange range = {});
  void string(const JsonPlace& object, const std::string& key);

 private:
  void one_index(const JsonPlace& place, std::string_view kind, std::size_t count);
  void one_number(const JsonPlace& place, NumberRange range);
  Status status_;
};

}  // namespace radfarm
