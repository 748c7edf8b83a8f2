#include "meters/isolux.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "image/color_map.h"
#include "image/png.h"

namespace radfarm {
namespace {

constexpr double kLines = 8;
constexpr std::size_t kLongerSide = 800;  // pixels
constexpr Rgba8 kNoMeter = {128, 128, 128, 255};
constexpr Rgba8 kLine = {20, 20, 20, 255};

/// Illuminance at a place in cells, by the four meters around it; those that are missing are left out. Nothing outside.
std::optional<double> illuminance_at(const WorkPlane& plane, std::span<const Reading> readings, double x, double z) {
  const auto own = static_cast<std::size_t>(z) * plane.columns + static_cast<std::size_t>(x);
  if (plane.meter_of[own] == kNone) return std::nullopt;
  double sum = 0, weights = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double column = std::floor(x - .5) + (corner & 1), row = std::floor(z - .5) + (corner >> 1);
    if (column < 0 || row < 0 || column >= static_cast<double>(plane.columns) || row >= static_cast<double>(plane.rows))
      continue;
    const std::uint32_t meter =
        plane.meter_of[static_cast<std::size_t>(row) * plane.columns + static_cast<std::size_t>(column)];
    if (meter == kNone) continue;
    const double weight = (1 - std::fabs(x - .5 - column)) * (1 - std::fabs(z - .5 - row));
    sum += weight * readings[meter].lux();
    weights += weight;
  }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

/// How many levels lie below; -1: nothing is known there.
int band(const std::optional<double>& lux, std::span<const double> levels) {
  if (!lux) return -1;
  return static_cast<int>(std::count_if(levels.begin(), levels.end(), [&](double level) { return *lux >= level; }));
}

}  // namespace

std::vector<double> contour_levels(double least, double most) {
  std::vector<double> levels;
  if (!(most > least) || !std::isfinite(most - least)) return levels;
  const double rough = (most - least) / kLines, power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough < 1.5 * power ? 1 : rough < 3.5 * power ? 2 : rough < 7.5 * power ? 5 : 10);
  for (double k = std::ceil(least / step); k * step <= most; ++k) levels.push_back(k * step);
  return levels;
}

Result<std::vector<std::byte>> isolux_png(const WorkPlane& plane, std::span<const Reading> readings,
                                          std::span<const double> levels) {
  const std::size_t scale = std::max<std::size_t>(1, kLongerSide / std::max(plane.columns, plane.rows));
  const std::size_t width = plane.columns * scale, height = plane.rows * scale;
  const Summary summary = summarise(readings);
  const ValueRange range{static_cast<float>(summary.least), static_cast<float>(summary.most)};
  std::vector<std::optional<double>> lux(width * height);
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const double to_cells = 1 / static_cast<double>(scale);
    lux[i] = illuminance_at(plane, readings, (static_cast<double>(i % width) + .5) * to_cells,
                            (static_cast<double>(i / width) + .5) * to_cells);
  }
  std::vector<Rgba8> pixels(lux.size(), kNoMeter);
  for (std::size_t i = 0; i < lux.size(); ++i) {
    if (!lux[i]) continue;
    const int here = band(lux[i], levels);
    const int right = (i + 1) % width != 0 ? band(lux[i + 1], levels) : here;
    const int below = i + width < lux.size() ? band(lux[i + width], levels) : here;
    const bool is_line = (right >= 0 && right != here) || (below >= 0 && below != here);
    pixels[i] = is_line ? kLine : viridis(range.place(static_cast<float>(*lux[i])));
  }
  return encode_png(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), pixels);
}

}  // namespace radfarm
