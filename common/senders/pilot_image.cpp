#include "senders/pilot_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace radfarm {
namespace {

constexpr int kMostPixels = 320;  // along each side of the pilot
constexpr std::size_t kSides = 6;

/// The side of a cube that a normal shows.
std::size_t side_of(const Vec3& n) {
  const float x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const int axis = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
  return static_cast<std::size_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

/// Mean irradiance, lux, of what the points around each vertex of the grid show, by the side they face.
class SmoothIrradiance {
 public:
  SmoothIrradiance(const PerspectiveGrid& grid, const VisiblePoints& seen) : grid_(grid), sums_(grid.vertex_count()) {
    std::vector<std::array<Sum, kSides>> cells(grid.cell_count());
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      if (seen.lights[i].irradiance < 0) continue;
      Sum& sum = cells[grid.cell_at(seen.points[i].position)][side_of(seen.points[i].normal)];
      sum.irradiance += static_cast<double>(seen.lights[i].irradiance);
      sum.count += 1;
    }
    for (std::uint32_t v = 0; v < sums_.size(); ++v) {
      for (const std::uint32_t cell : grid.cells_around(v)) {
        for (std::size_t side = 0; side < kSides; ++side) {
          sums_[v][side].irradiance += cells[cell][side].irradiance;
          sums_[v][side].count += cells[cell][side].count;
        }
      }
    }
  }

  double at(const ReceiverPoint& point) const {
    const Interpolation around = interpolate(grid_, point.position);
    const std::size_t side = side_of(point.normal);
    double sum = 0, weights = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Sum& known = sums_[around.vertices[i]][side];
      const auto weight = static_cast<double>(around.weights[i]);
      if (known.count > 0) sum += weight * known.irradiance / known.count, weights += weight;
    }
    return weights > 0 ? sum / weights : 0;
  }

 private:
  struct Sum {
    double irradiance = 0;
    double count = 0;
  };
  const PerspectiveGrid& grid_;
  std::vector<std::array<Sum, kSides>> sums_;
};

}  // namespace

std::size_t PilotImage::pixel_of(std::uint32_t film_pixel, int film_width) const {
  const auto width = static_cast<std::uint32_t>(film_width), side = static_cast<std::uint32_t>(block);
  return (film_pixel / width / side) * static_cast<std::size_t>(radiance.width) + film_pixel % width / side;
}

PilotImage make_pilot_image(const World& world, const Prepass& film, const PerspectiveGrid& grid, const VisiblePoints& seen) {
  PilotImage pilot;
  pilot.block = (std::max(film.width, film.height) + kMostPixels - 1) / kMostPixels;
  const auto blocks = [&](int pixels) { return (pixels + pilot.block - 1) / pilot.block; };
  const auto size = static_cast<std::size_t>(blocks(film.width)) * static_cast<std::size_t>(blocks(film.height));
  pilot.radiance = {blocks(film.width), blocks(film.height), std::vector<float>(size)};
  const SmoothIrradiance irradiance(grid, seen);
  std::vector<double> sums(size), wanted(size);
  std::vector<std::uint32_t> hits(static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height));
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const ReceiverPoint& point = seen.points[i];
    const std::size_t pixel = pilot.pixel_of(seen.pixels[i], film.width);
    sums[pixel] += static_cast<double>(seen.lights[i].emission) +
                   static_cast<double>(point.reflectance) * irradiance.at(point) / std::numbers::pi;
    ++hits[seen.pixels[i]];
  }
  for (std::uint32_t p = 0; p < hits.size(); ++p) {
    const std::size_t pixel = pilot.pixel_of(p, film.width);
    wanted[pixel] += film.samples;
    if (hits[p] == film.samples || world.environment.is_empty()) continue;
    const auto width = static_cast<std::uint32_t>(film.width);
    const Ray ray = camera_ray(film.camera, film.width, film.height, static_cast<float>(p % width) + 0.5F,
                               static_cast<float>(p / width) + 0.5F);
    sums[pixel] += (film.samples - hits[p]) * static_cast<double>(luminance(world.environment.radiance(ray.direction)));
  }
  for (std::size_t i = 0; i < size; ++i) pilot.radiance.values[i] = static_cast<float>(sums[i] / wanted[i]);
  return pilot;
}

}  // namespace radfarm
