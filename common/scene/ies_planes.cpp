#include "scene/ies_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "scene/photometry.h"

namespace radfarm {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

tl::unexpected<Error> bad(const std::string& what) { return fail(Code::kInvalidArgument, what); }
std::string degrees(double angle) {
  std::string text = std::to_string(angle);
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

std::vector<float> to_floats(const std::vector<double>& values) {
  std::vector<float> floats(values.size());
  std::transform(values.begin(), values.end(), floats.begin(), [](double value) { return static_cast<float>(value); });
  return floats;
}

/// Planes on one side of the plane through C = 90 and 270 give the other side.
Photometry mirror_about_90(const Photometry& half) {
  Photometry full = half;
  std::vector<std::pair<float, std::size_t>> planes;  // C and its row in `half`
  for (std::size_t j = 0; j < half.c.size(); ++j) {
    planes.emplace_back(half.c[j], j);
    const float mirrored = 540 - half.c[j];
    if (half.c[j] > 90 && half.c[j] < 270) planes.emplace_back(mirrored > 360 ? mirrored - 360 : mirrored, j);
    if (half.c[j] == 180) planes.emplace_back(0.0F, j);
  }
  std::sort(planes.begin(), planes.end());
  full.c.clear();
  full.candela.clear();
  for (const auto& [c, row] : planes) {
    full.c.push_back(c);
    const auto begin = half.candela.begin() + static_cast<std::ptrdiff_t>(row * half.gamma.size());
    full.candela.insert(full.candela.end(), begin, begin + static_cast<std::ptrdiff_t>(half.gamma.size()));
  }
  return full;
}

Result<Photometry> from_type_c(const IesTable& table) {
  if (table.vertical.front() < 0 || table.vertical.back() > 180) {
    return bad("vertical angles of type C should be from 0 to 180 degrees, but are from " +
               degrees(table.vertical.front()) + " to " + degrees(table.vertical.back()));
  }
  Photometry c;
  c.gamma = to_floats(table.vertical);
  c.c = to_floats(table.horizontal);
  c.candela = to_floats(table.candela);
  const float first = c.c.front(), last = c.c.back();
  if (c.c.size() == 1) {
    c.c = {0};  // whatever the angle is called
    return c;
  }
  const bool has_180 = std::find(c.c.begin(), c.c.end(), 180.0F) != c.c.end();
  if (first == 90 && last == 270 && has_180) return mirror_about_90(c);
  if (first == 0 && last > 180 && last < 360) {
    c.c.push_back(360);
    c.candela.insert(c.candela.end(), c.candela.begin(),
                     c.candela.begin() + static_cast<std::ptrdiff_t>(c.gamma.size()));
    return c;
  }
  if (first == 0 && (last == 90 || last == 180 || last == 360)) return c;
  return bad(
      "horizontal angles of type C should be just 0, or from 0 to 90, 180 or 360, or from 90 over 180 to 270 degrees, "
      "but are from " +
      degrees(table.horizontal.front()) + " to " + degrees(table.horizontal.back()));
}

/// The value of an ascending list's entry that is next below or at `value`, and how far to the one after.
struct Between {
  std::size_t first, second;
  double share;
};
Between find(const std::vector<double>& ascending, double value) {
  const auto above = std::upper_bound(ascending.begin(), ascending.end(), value);
  if (above == ascending.begin()) return {0, 0, 0};
  const auto first = static_cast<std::size_t>(above - ascending.begin()) - 1;
  if (above == ascending.end()) return {first, first, 0};
  return {first, first + 1, (value - ascending[first]) / (*above - ascending[first])};
}

/// Angles that begin at 0 hold for both sides.
double candela_of(const IesTable& table, double vertical, double horizontal) {
  const auto beside = [](const std::vector<double>& angles, double& angle) {
    if (angles.front() == 0) angle = std::fabs(angle);
    constexpr double kRounding = 1e-9;  // degrees, of the conversion
    return angle < angles.front() - kRounding || angle > angles.back() + kRounding;
  };
  if (beside(table.vertical, vertical) || beside(table.horizontal, horizontal)) return 0;
  const Between v = find(table.vertical, vertical), h = find(table.horizontal, horizontal);
  const auto along = [&](std::size_t j) {
    return std::lerp(table.candela[j * table.vertical.size() + v.first],
                     table.candela[j * table.vertical.size() + v.second], v.share);
  };
  return std::lerp(along(h.first), along(h.second), h.share);
}

/// Type A has its poles above and below and type B to the sides: latitude is V in the one and H in the other.
double candela_at_type_c(const IesTable& table, double gamma, double c) {
  const double ahead = std::cos(gamma), right = std::sin(gamma) * std::cos(c), up = std::sin(gamma) * std::sin(c);
  const bool is_a = table.type == IesTable::Type::kA;
  const double vertical = is_a ? std::atan2(up, std::hypot(ahead, right)) : std::atan2(up, ahead);
  const double horizontal = is_a ? std::atan2(right, ahead) : std::atan2(right, std::hypot(ahead, up));
  return candela_of(table, vertical / kDegree, horizontal / kDegree);
}

/// Of the table with its own interpolation: the integral of intensity times the cosine of the latitude, by Gauss, two
/// by two points a quarter of each cell.
double own_lumens(const IesTable& table) {
  const bool is_a = table.type == IesTable::Type::kA;
  const auto& latitude = is_a ? table.vertical : table.horizontal;
  const auto& longitude = is_a ? table.horizontal : table.vertical;
  const double root = std::sqrt(1.0 / 12);
  const std::array points = {0.25 - root / 2, 0.25 + root / 2, 0.75 - root / 2, 0.75 + root / 2};
  double sum = 0;
  for (std::size_t i = 0; i + 1 < latitude.size(); ++i) {
    for (std::size_t j = 0; j + 1 < longitude.size(); ++j) {
      const double height = latitude[i + 1] - latitude[i], width = longitude[j + 1] - longitude[j];
      for (std::size_t k = 0; k < 16; ++k) {
        const double lat = latitude[i] + height * points[k / 4], lon = longitude[j] + width * points[k % 4];
        sum += candela_of(table, is_a ? lat : lon, is_a ? lon : lat) * std::cos(lat * kDegree) * height * width / 16;
      }
    }
  }
  const int sides = (latitude.front() == 0 ? 2 : 1) * (longitude.front() == 0 ? 2 : 1);
  return sum * kDegree * kDegree * sides;
}

double finest_step(const std::vector<double>& angles) {
  double step = 180;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) step = std::min(step, angles[i + 1] - angles[i]);
  return step;
}

Result<Photometry> from_type_a_or_b(const IesTable& table) {
  for (const auto* angles : {&table.vertical, &table.horizontal}) {
    if (angles->size() >= 2 && angles->front() >= -90 && angles->back() <= 90 && angles->front() <= 0) continue;
    return bad(std::string(angles == &table.vertical ? "vertical" : "horizontal") +
               " angles of types A and B should be two or more from -90 or 0 to 90 degrees, but are from " +
               degrees(angles->front()) + " to " + degrees(angles->back()));
  }
  const double step = std::clamp(std::min(finest_step(table.vertical), finest_step(table.horizontal)), 0.25, 1.0);
  const int steps = static_cast<int>(std::ceil(90 / step));
  const bool is_quarter = table.vertical.front() == 0 && table.horizontal.front() == 0;
  Photometry c;
  for (int i = 0; i <= steps; ++i) c.gamma.push_back(static_cast<float>(90.0 * i / steps));
  for (int j = 0; j <= (is_quarter ? steps : 4 * steps); ++j) c.c.push_back(static_cast<float>(90.0 * j / steps));
  for (std::size_t j = 0; j < c.c.size(); ++j) {
    for (std::size_t i = 0; i < c.gamma.size(); ++i) {
      const double quarter = std::numbers::pi / 2 / steps;
      c.candela.push_back(static_cast<float>(
          candela_at_type_c(table, static_cast<double>(i) * quarter, static_cast<double>(j) * quarter)));
    }
  }
  const double resampled = zonal_lumens(c);
  const auto scale = static_cast<float>(resampled > 0 ? own_lumens(table) / resampled : 1);
  for (float& value : c.candela) value *= scale;
  return c;
}

}  // namespace

Result<Photometry> to_type_c(const IesTable& table) {
  return table.type == IesTable::Type::kC ? from_type_c(table) : from_type_a_or_b(table);
}

}  // namespace radfarm
