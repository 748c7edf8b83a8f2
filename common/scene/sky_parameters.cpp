#include "scene/sky_parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "scene/daylight.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

// The first five are a place and time.
constexpr std::array<std::string_view, 15> kKeys = {"lat",       "lon",     "date",      "time",      "zone",
                                                    "elevation", "azimuth", "type",      "turbidity", "sun_lux",
                                                    "sky_lux",   "lux",     "luminance", "ground",    "north"};

using Values = std::map<std::string_view, std::string_view>;

tl::unexpected<Error> bad(const std::string& what) { return fail(Code::kInvalidArgument, "sky: " + what); }

Result<double> number(std::string_view key, std::string_view text, double low, double high) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = error == std::errc() && stop == digits.data() + digits.size();
  if (is_whole && value >= low && value <= high) return value;
  const auto short_text = [](double v) {
    std::array<char, 32> buffer{};
    return std::string(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), v).ptr);
  };
  return bad(std::string(key) + "=" + std::string(text) + " should be a number from " + short_text(low) + " to " +
             short_text(high));
}

/// Reads up to three whole numbers with `separator` between them; how many, or 0 when it is anything else.
int whole_numbers(std::string_view text, char separator, std::array<int, 3>& out) {
  for (int count = 0; count < 3; ++count) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, out[static_cast<std::size_t>(count)]);
    if (error != std::errc() || stop != text.data() + end || text[0] == '-') return 0;
    if (end == text.size()) return count + 1;
    text.remove_prefix(end + 1);
  }
  return 0;
}

Status read_date(std::string_view text, PlaceAndTime& at) {
  std::array<int, 3> parts{};
  const bool is_date = whole_numbers(text, '-', parts) == 3;
  const std::chrono::year_month_day date{std::chrono::year(parts[0]),
                                         std::chrono::month(static_cast<unsigned>(parts[1])),
                                         std::chrono::day(static_cast<unsigned>(parts[2]))};
  if (!is_date || !date.ok() || parts[0] < 1800 || parts[0] > 2200) {
    return bad("date=" + std::string(text) + " should be a day of the calendar from 1800 to 2200 as YYYY-MM-DD");
  }
  at.year = parts[0], at.month = parts[1], at.day = parts[2];
  return {};
}

Status read_time(std::string_view text, PlaceAndTime& at) {
  std::array<int, 3> parts{};
  if (whole_numbers(text, ':', parts) < 2 || parts[0] > 24 || parts[1] > 59 || parts[2] > 59) {
    return bad("time=" + std::string(text) + " should be HH:MM or HH:MM:SS");
  }
  at.hour = parts[0] + parts[1] / 60.0 + parts[2] / 3600.0;
  return {};
}

Result<PlaceAndTime> read_place_and_time(const Values& values) {
  PlaceAndTime at;
  for (const char* key : {"lat", "lon", "date", "time", "zone"}) {
    if (!values.contains(key))
      return bad(std::string(key) + "= is missing: a place and time are lat, lon, date, time and zone");
  }
  for (const char* key : {"elevation", "azimuth"}) {
    if (values.contains(key))
      return bad(std::string(key) + "= and a place and time say both where the sun is; give one of them");
  }
  RADFARM_TRY(at.latitude, number("lat", values.at("lat"), -90, 90));
  RADFARM_TRY(at.longitude, number("lon", values.at("lon"), -180, 180));
  RADFARM_TRY(at.zone, number("zone", values.at("zone"), -14, 14));
  RADFARM_TRY_STATUS(read_date(values.at("date"), at));
  RADFARM_TRY_STATUS(read_time(values.at("time"), at));
  return at;
}

std::string known_keys() {
  std::string all;
  for (const std::string_view key : kKeys) all += std::string(key) + "=, ";
  return all + "overcast, clear, uniform";
}

/// The parameters by name. Those without "=" are names of skies, of which there is at most one.
Result<Values> split(std::string_view text) {
  Values values;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view item = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string_view key = item.substr(0, equals);
    const bool is_name = key == "overcast" || key == "clear" || key == "uniform";
    const bool is_known = is_name || std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
    if (!is_known || is_name != (equals == item.size())) {
      return bad("'" + std::string(item.substr(0, 60)) + "' is not known; there are " + known_keys());
    }
    const std::string_view name = is_name ? "type" : key;
    if (!values.emplace(name, is_name ? key : item.substr(equals + 1)).second)
      return bad(std::string(name) + " is given twice");
  }
  return values;
}

Status read_kind(const Values& values, SkyParameters& sky) {
  const auto type = values.find("type");
  if (type == values.end()) return {};
  sky.is_uniform = type->second == "uniform";
  if (type->second == "overcast") sky.type = kSkyTypes;
  if (sky.is_uniform || type->second == "overcast" || type->second == "clear") return {};
  RADFARM_TRY(const double value, number("type", type->second, 1, kSkyTypes));
  if (value != std::floor(value)) return bad("type=" + std::string(type->second) + " should be a whole number");
  sky.type = static_cast<int>(value);
  return {};
}

}  // namespace

Result<SkyParameters> parse_sky(std::string_view text) {
  RADFARM_TRY(const Values values, split(text));
  SkyParameters sky;
  RADFARM_TRY_STATUS(read_kind(values, sky));
  const bool has_place = std::any_of(kKeys.begin(), kKeys.begin() + 5, [&](auto key) { return values.contains(key); });
  if (has_place) {
    RADFARM_TRY(sky.at, read_place_and_time(values));
  }
  struct Number {
    const char* key;
    double low, high;
    double* plain;
    std::optional<double>* optional;
  };
  for (const Number& n :
       {Number{"elevation", -90, 90, &sky.elevation, nullptr}, Number{"azimuth", -360, 360, &sky.azimuth, nullptr},
        Number{"turbidity", 1, 100, nullptr, &sky.turbidity}, Number{"ground", 0, 1, &sky.ground, nullptr},
        Number{"sun_lux", 0, limits::kLight, nullptr, &sky.sun_lux}, Number{"north", -360, 360, &sky.north, nullptr},
        Number{"sky_lux", 0, limits::kLight, nullptr, &sky.sky_lux},
        Number{"lux", 0, limits::kLight, nullptr, &sky.sky_lux},
        Number{"luminance", 0, limits::kLight, nullptr, &sky.luminance}}) {
    const auto found = values.find(n.key);
    if (found == values.end()) continue;
    RADFARM_TRY(const double value, number(n.key, found->second, n.low, n.high));
    if (n.optional != nullptr)
      *n.optional = value;
    else
      *n.plain = value;
  }
  const int levels = static_cast<int>(values.contains("sky_lux")) + static_cast<int>(values.contains("lux")) +
                     static_cast<int>(values.contains("luminance"));
  if (levels > 1) return bad("sky_lux, lux and luminance say the same; give one of them");
  if (sky.luminance && !sky.is_uniform) return bad("luminance= is for sky:uniform; give sky_lux=");
  if (sky.is_uniform && levels == 0) return bad("uniform needs lux= (of the ground) or luminance= (cd/m^2)");
  return sky;
}

}  // namespace radfarm
