#include "senders/receivers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "math/sobol.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPrepassKey = 0x70726570;  // "prep"
constexpr float kMargin = 1.02F;                   // the grid reaches a little beyond the depths seen

VisiblePoints::Light light_at(const World& world, const ReflectorLookup& lookup, std::uint32_t id, const SurfacePoint& point) {
  VisiblePoints::Light light{luminance(world.emission(point)), -1};
  if (id == kNone) return light;
  const Reflector& reflector = lookup.tree().reflectors[id];
  const Spectrum& believed = reflector.is_doubtful != 0 ? reflector.of_direct : reflector.radiance;
  if (reflector.reflectance > 0) light.irradiance = kPi * luminance(believed) / reflector.reflectance;
  return light;
}

VisiblePoints visible_in_row(const World& world, const ReflectorLookup& lookup, const Prepass& film, int y) {
  VisiblePoints row;
  for (int x = 0; x < film.width; ++x) {
    const std::uint64_t key = combine(film.seed, kPrepassKey, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
    for (std::uint32_t s = 0; s < film.samples; ++s) {
      const Vec2 jitter = sobol_owen_2d(s, key);
      const Ray ray = camera_ray(film.camera, film.width, film.height, static_cast<float>(x) + jitter.x,
                                 static_cast<float>(y) + jitter.y);
      const auto hit = world.caster.closest(ray, combine(key, s));
      if (!hit) continue;
      SurfacePoint point = world.surfaces.at(*hit);
      face(point, -ray.direction);
      row.points.push_back({leave(point), point.shading_normal, luminance(world.surfaces.reflectance(point))});
      row.reflectors.push_back(lookup.find(*hit, point));
      row.lights.push_back(light_at(world, lookup, row.reflectors.back(), point));
      row.pixels.push_back(static_cast<std::uint32_t>(y * film.width + x));
    }
  }
  return row;
}

}  // namespace

VisiblePoints find_visible_points(const World& world, const ReflectorLookup& lookup, const Prepass& film, const Progress& progress) {
  std::vector<VisiblePoints> rows(static_cast<std::size_t>(film.height));
  parallel_for(progress, "senders: visible points", rows.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) rows[y] = visible_in_row(world, lookup, film, static_cast<int>(y));
  });
  VisiblePoints all;
  for (const VisiblePoints& row : rows) {
    all.points.insert(all.points.end(), row.points.begin(), row.points.end());
    all.lights.insert(all.lights.end(), row.lights.begin(), row.lights.end());
    all.pixels.insert(all.pixels.end(), row.pixels.begin(), row.pixels.end());
    all.reflectors.insert(all.reflectors.end(), row.reflectors.begin(), row.reflectors.end());
  }
  return all;
}

double mean_reflected(const VisiblePoints& seen) {
  double sum = 0;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    sum += static_cast<double>(seen.points[i].reflectance) * std::max(0.0, static_cast<double>(seen.lights[i].irradiance));
  }
  return seen.points.empty() ? 0 : sum / std::numbers::pi / static_cast<double>(seen.points.size());
}

PerspectiveGrid fit_grid(const Camera& camera, int width, int height, const std::vector<ReceiverPoint>& points,
                         const SenderSettings& settings) {
  PerspectiveGrid grid;
  grid.camera = camera;
  grid.camera.name.clear();
  grid.film_aspect = static_cast<float>(width) / static_cast<float>(height);
  grid.film_height = static_cast<float>(height);
  grid.columns = settings.columns;
  grid.rows = settings.rows;
  grid.slices = settings.slices;
  float nearest = std::numeric_limits<float>::infinity(), farthest = 0;
  for (const ReceiverPoint& point : points) {
    const float z = dot(point.position - camera.position, camera.forward);
    if (!(z > 0)) continue;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  if (!(farthest > 0)) return grid;
  // A camera that touches a surface sees depth 0: nearer than 1e-4 of the farthest depth cells would shrink without end.
  grid.near = std::max(nearest, 1e-4F * farthest) / kMargin;
  grid.far = farthest * kMargin;
  return grid;
}

Receivers sort_into_cells(const PerspectiveGrid& grid, const std::vector<ReceiverPoint>& points,
                          std::uint32_t per_cell) {
  std::vector<std::uint32_t> cell_of(points.size()), order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) cell_of[i] = grid.cell_at(points[i].position);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cell_of[a] < cell_of[b]; });
  Receivers receivers;
  receivers.first_of_cell.assign(grid.cell_count() + 1, 0);
  for (std::size_t begin = 0; begin < order.size();) {
    const std::uint32_t cell = cell_of[order[begin]];
    std::size_t end = begin;
    while (end < order.size() && cell_of[order[end]] == cell) ++end;
    const std::size_t kept = std::min<std::size_t>(end - begin, per_cell);
    for (std::size_t i = 0; i < kept; ++i) {
      receivers.points.push_back(points[order[begin + i * (end - begin) / kept]]);
    }
    receivers.first_of_cell[cell + 1] = static_cast<std::uint32_t>(kept);
    begin = end;
  }
  std::partial_sum(receivers.first_of_cell.begin(), receivers.first_of_cell.end(), receivers.first_of_cell.begin());
  return receivers;
}

float mean_reflectance(std::span<const ReceiverPoint> receivers) {
  float sum = 0;
  for (const ReceiverPoint& receiver : receivers) sum += receiver.reflectance;
  return receivers.empty() ? 0 : sum / static_cast<float>(receivers.size());
}

std::vector<ReceiverPoint> receivers_around(const PerspectiveGrid& grid, const Receivers& receivers,
                                            std::uint32_t vertex, std::uint32_t wanted) {
  std::vector<ReceiverPoint> all;
  for (const std::uint32_t cell : grid.cells_around(vertex)) {
    for (std::uint32_t p = receivers.first_of_cell[cell]; p < receivers.first_of_cell[cell + 1]; ++p) {
      all.push_back(receivers.points[p]);
    }
  }
  if (all.empty()) return {{grid.vertex_position(vertex), Vec3(0, 0, 0), 0.5F}};
  const std::size_t kept = std::min<std::size_t>(all.size(), wanted);
  std::vector<ReceiverPoint> chosen;
  for (std::size_t n = 0; n < kept; ++n) chosen.push_back(all[n * all.size() / kept]);
  return chosen;
}

}  // namespace radfarm
