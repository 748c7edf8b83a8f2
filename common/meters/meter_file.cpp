#include "meters/meter_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <spdlog/fmt/fmt.h>

namespace radfarm {
namespace {

constexpr std::size_t kMostMeters = 10'000'000;

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The numbers of a line; nothing where one is not a finite number.
std::optional<std::vector<double>> numbers(std::string_view line) {
  std::vector<double> all;
  while (true) {
    const std::size_t comma = std::min(line.find(','), line.size());
    const std::string_view field = trimmed(line.substr(0, comma));
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
    all.push_back(value);
    if (comma == line.size()) return all;
    line.remove_prefix(comma + 1);
  }
}

Result<Meter> meter_of(const std::vector<double>& n, std::size_t line, const Vec3d& origin) {
  const auto refuse = [&](const char* what) {
    return fail(Code::kInvalidArgument, "line " + std::to_string(line) + ": " + what);
  };
  if (n.size() != 3 && n.size() != 6) return refuse("needs x,y,z or x,y,z,nx,ny,nz");
  Meter meter{to_float(Vec3d(n[0], n[1], n[2]) - origin), {0, 1, 0}};
  if (n.size() == 3) return meter;
  const Vec3d normal(n[3], n[4], n[5]);
  if (!(length(normal) > 0) || !std::isfinite(length(normal))) return refuse("the normal has no direction");
  meter.normal = to_float(normalize(normal));
  return meter;
}

}  // namespace

Result<std::vector<Meter>> read_meters(std::string_view csv, const Vec3d& origin) {
  std::vector<Meter> meters;
  bool may_be_header = true;
  for (std::size_t line = 1; !csv.empty(); ++line) {
    const std::size_t end = std::min(csv.find('\n'), csv.size());
    const std::string_view text = trimmed(csv.substr(0, end));
    csv.remove_prefix(std::min(csv.size(), end + 1));
    if (text.empty() || text.front() == '#') continue;
    const auto values = numbers(text);
    if (!values && !may_be_header)
      return fail(Code::kInvalidArgument, "line " + std::to_string(line) + ": '" + std::string(text.substr(0, 60)) +
                                              "' is not numbers with commas between");
    may_be_header = false;
    if (!values) continue;
    RADFARM_TRY(const Meter meter, meter_of(*values, line, origin));
    meters.push_back(meter);
    if (meters.size() > kMostMeters) return fail(Code::kResourceExhausted, "more than 10000000 points");
  }
  if (meters.empty()) return fail(Code::kInvalidArgument, "has no points; a line each of x,y,z or x,y,z,nx,ny,nz");
  return meters;
}

std::string write_readings(std::span<const Meter> meters, std::span<const Reading> readings, const Vec3d& origin) {
  std::string text = "x,y,z,nx,ny,nz,lux,lux_low,lux_high,red,green,blue,samples\n";
  for (std::size_t i = 0; i < meters.size(); ++i) {
    const Vec3d p = to_double(meters[i].point) + origin;
    const Vec3& n = meters[i].normal;
    const Reading& r = readings[i];
    fmt::format_to(std::back_inserter(text),
                   "{:.7g},{:.7g},{:.7g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", p.x, p.y,
                   p.z, n.x, n.y, n.z, r.lux(), std::max(0.0, r.lux() - r.half_width), r.lux() + r.half_width,
                   r.irradiance.r, r.irradiance.g, r.irradiance.b, r.samples);
  }
  return text;
}

}  // namespace radfarm
