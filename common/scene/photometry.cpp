#include "scene/photometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/cumulative.h"

namespace radfarm {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Between which two entries of an ascending list a value lies, and where.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0;
};
Between find(const std::vector<float>& ascending, double value) {
  const auto above = std::upper_bound(ascending.begin(), ascending.end(), value,
                                      [](double v, float entry) { return v < static_cast<double>(entry); });
  if (above == ascending.begin()) return {0, 0, 0};
  const auto first = static_cast<std::size_t>(above - ascending.begin()) - 1;
  if (above == ascending.end()) return {first, first, 0};
  const auto low = static_cast<double>(ascending[first]), high = static_cast<double>(*above);
  return {first, first + 1, (value - low) / (high - low)};
}

/// Any C in the range that the table has.
double fold(double c, double last) {
  c -= 360 * std::floor(c / 360);
  if (last <= 180 && c > 180) c = 360 - c;
  if (last <= 90 && c > 90) c = 180 - c;
  return c;
}

/// Mean over all C of the intensity at the table's i-th gamma, by trapezoids.
double mean_around(const Photometry& table, std::size_t i) {
  const std::size_t rows = table.gamma.size();
  if (table.c.size() == 1) return static_cast<double>(table.candela[i]);
  double sum = 0;
  for (std::size_t j = 0; j + 1 < table.c.size(); ++j) {
    const double width = static_cast<double>(table.c[j + 1]) - static_cast<double>(table.c[j]);
    sum += width / 2 *
           (static_cast<double>(table.candela[j * rows + i]) + static_cast<double>(table.candela[(j + 1) * rows + i]));
  }
  return sum / (static_cast<double>(table.c.back()) - static_cast<double>(table.c.front()));
}

Vec3 across(const PunctualLight& light) { return cross(light.right, light.direction); }

/// Angles mirrored until they go around.
std::vector<float> all_around(std::vector<float> c) {
  if (c.size() == 1) return {0, 360};
  for (const float half : {90.0F, 180.0F}) {
    if (c.back() != half) continue;
    for (std::size_t i = c.size() - 1; i-- > 0;) c.push_back(2 * half - c[i]);
  }
  return c;
}

}  // namespace

double candela_at(const Photometry& table, double gamma, double c) {
  if (table.gamma.empty() || gamma < static_cast<double>(table.gamma.front()) ||
      gamma > static_cast<double>(table.gamma.back())) {
    return 0;
  }
  const Between row = find(table.gamma, gamma), plane = find(table.c, fold(c, static_cast<double>(table.c.back())));
  const std::size_t rows = table.gamma.size();
  const auto along = [&](std::size_t j) {
    return std::lerp(static_cast<double>(table.candela[j * rows + row.first]),
                     static_cast<double>(table.candela[j * rows + row.second]), row.share);
  };
  return std::lerp(along(plane.first), along(plane.second), plane.share);
}

float candela(const Photometry& table, const Vec3& way, const PunctualLight& light) {
  const Vec3d w = to_double(way);
  const double x = dot(w, to_double(light.right)), y = dot(w, to_double(across(light)));
  const double gamma = std::atan2(std::hypot(x, y), dot(w, to_double(light.direction))) / kDegree;
  return static_cast<float>(candela_at(table, gamma, std::atan2(y, x) / kDegree));
}

double zonal_lumens(const Photometry& table) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < table.gamma.size(); ++i) {
    const double a = static_cast<double>(table.gamma[i]) * kDegree,
                 b = static_cast<double>(table.gamma[i + 1]) * kDegree;
    // The integral of sin over the zone, and the part of it that a line from 0 at a to 1 at b weighs.
    const double zone = 2 * std::sin((a + b) / 2) * std::sin((b - a) / 2);
    const double later = (std::sin(b) - std::sin(a)) / (b - a) - std::cos(b);
    sum += mean_around(table, i) * (zone - later) + mean_around(table, i + 1) * later;
  }
  return 2 * std::numbers::pi * sum;
}

float max_candela(const Photometry& table) {
  float most = 0;
  for (const float value : table.candela) most = std::max(most, value);
  return most;
}

PhotometrySampler::PhotometrySampler(const Photometry& table) : gamma_(table.gamma), c_(all_around(table.c)) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < gamma_.size(); ++i) {
    const double zone =
        std::cos(static_cast<double>(gamma_[i]) * kDegree) - std::cos(static_cast<double>(gamma_[i + 1]) * kDegree);
    for (std::size_t j = 0; j + 1 < c_.size(); ++j) {
      double corners = 0;
      for (const float gamma : {gamma_[i], gamma_[i + 1]}) {
        for (const float c : {c_[j], c_[j + 1]})
          corners += candela_at(table, static_cast<double>(gamma), static_cast<double>(c)) / 4;
      }
      sum += corners * zone * static_cast<double>(c_[j + 1] - c_[j]) * kDegree;
      sums_.push_back(sum);
    }
  }
}

PhotometrySampler::Sample PhotometrySampler::sample(const Vec2& u, const PunctualLight& light) const {
  const CumulativePosition chosen = find_in_sums(sums_, static_cast<double>(u.x));
  const std::size_t i = chosen.index / (c_.size() - 1), j = chosen.index % (c_.size() - 1);
  const double top = std::cos(static_cast<double>(gamma_[i]) * kDegree),
               bottom = std::cos(static_cast<double>(gamma_[i + 1]) * kDegree);
  const double c0 = static_cast<double>(c_[j]) * kDegree, c1 = static_cast<double>(c_[j + 1]) * kDegree;
  const double cosine = std::lerp(top, bottom, chosen.share), angle = std::lerp(c0, c1, static_cast<double>(u.y));
  const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
  const Vec3d way = to_double(light.right) * (sine * std::cos(angle)) +
                    to_double(across(light)) * (sine * std::sin(angle)) + to_double(light.direction) * cosine;
  return {to_float(normalize(way)), static_cast<float>(chosen.probability / ((top - bottom) * (c1 - c0)))};
}

}  // namespace radfarm
