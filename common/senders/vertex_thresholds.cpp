#include "senders/vertex_thresholds.h"

#include <algorithm>
#include <cmath>

#include "image/tone_map.h"

namespace radfarm {
namespace {

struct Sum {
  double threshold = 0;
  double points = 0;
  double mean_or(double otherwise) const { return points > 0 ? threshold / points : otherwise; }
};

/// A vertex has the mean of what the cells around it hold.
std::vector<float> spread_to_vertices(const PerspectiveGrid& grid, const std::vector<Sum>& cells, double mean) {
  std::vector<float> values(grid.vertex_count());
  for (std::uint32_t v = 0; v < values.size(); ++v) {
    Sum around;
    for (const std::uint32_t cell : grid.cells_around(v)) {
      around.threshold += cells[cell].threshold;
      around.points += cells[cell].points;
    }
    values[v] = static_cast<float>(around.mean_or(mean));
  }
  return values;
}

}  // namespace

VertexThresholds even_thresholds(const PerspectiveGrid& grid, float threshold) {
  VertexThresholds even;
  even.values.assign(grid.vertex_count(), threshold);
  even.mean = even.mean_plain = static_cast<double>(threshold);
  return even;
}

VertexThresholds visible_thresholds(const World& world, const Prepass& film, const PerspectiveGrid& grid,
                                    const VisiblePoints& seen, const SenderSettings& settings) {
  const PilotImage pilot = make_pilot_image(world, film, grid, seen);
  if (!(mean_of(pilot.radiance) > 0)) return even_thresholds(grid, settings.threshold);
  VertexThresholds result;
  result.exposure_ev = auto_exposure(pilot.radiance.values);
  const double scale = kDisplayWhite * std::exp2(static_cast<double>(result.exposure_ev));
  const double density = pixels_per_degree(film.camera, film.height) / pilot.block;
  Visibility visibility = judge_visibility(displayed(pilot.radiance, result.exposure_ev), density, settings.max_elevation);
  std::vector<Sum> cells(grid.cell_count());
  Sum all, plain;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    if (!(seen.points[i].reflectance > 0)) continue;  // nothing that is gathered shows there
    const std::size_t pixel = pilot.pixel_of(seen.pixels[i], film.width);
    const double difference = visible_difference(static_cast<double>(visibility.adaptation.values[pixel])) / scale *
                              static_cast<double>(settings.threshold_scale);
    const double threshold = difference * static_cast<double>(visibility.elevation.values[pixel]);
    Sum& cell = cells[grid.cell_at(seen.points[i].position)];
    cell.threshold += threshold, cell.points += 1;
    all.threshold += threshold, all.points += 1;
    plain.threshold += difference, plain.points += 1;
  }
  const auto otherwise = static_cast<double>(settings.threshold);
  result.mean = all.mean_or(otherwise), result.mean_plain = plain.mean_or(otherwise);
  result.values = spread_to_vertices(grid, cells, result.mean);
  result.elevation = std::move(visibility.elevation);
  return result;
}

}  // namespace radfarm
