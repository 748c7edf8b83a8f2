#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "scene/world.h"
#include "senders/grid.h"
#include "senders/reflector_lookup.h"

namespace radfarm {

/// A visible surface point found by the prepass: where light is wanted.
struct ReceiverPoint {
  Vec3 position{0, 0, 0};  // already off the surface, on the visible side
  Vec3 normal{0, 0, 0};    // unit, towards the viewer; zero for a point in free space
  float reflectance = 0;   // luminance of rho
};

/// Receiver points by grid cell: those of cell c are points[first_of_cell[c]] up to first_of_cell[c + 1].
struct Receivers {
  std::vector<ReceiverPoint> points;
  std::vector<std::uint32_t> first_of_cell;  // one a cell and one past the last
};

/// The samples of the film that look where light is wanted.
struct Prepass {
  const Camera& camera;
  int width = 0;   // pixels
  int height = 0;
  std::uint32_t samples = 1;  // a pixel
  std::uint64_t seed = 0;
};

/// What a camera sees: one receiver point a film sample that hits something, in the order of pixels, and its light by the
/// radiosity solution.
struct VisiblePoints {
  struct Light {
    float emission = 0;     // luminance towards the viewer, cd/m^2
    float irradiance = -1;  // luminance, lux, mean over the patch; below 0: unknown, since nothing is reflected there
  };
  std::vector<ReceiverPoint> points;
  std::vector<Light> lights;          // of each point
  std::vector<std::uint32_t> pixels;  // of each point: y * width + x
  std::vector<std::uint32_t> reflectors;  // of each point: the patch it is of; kNone where nothing is reflected
};
VisiblePoints find_visible_points(const World& world, const ReflectorLookup& lookup, const Prepass& film,
                                  const Progress& progress = {});

/// Mean luminance that the points reflect, cd/m^2; 0 of none.
double mean_reflected(const VisiblePoints& seen);

/// A grid over the depths of the points, a little wider.
PerspectiveGrid fit_grid(const Camera& camera, int width, int height, const std::vector<ReceiverPoint>& points,
                         const SenderSettings& settings);

/// Sorts the points into the grid's cells and keeps at most `per_cell` of each, spread evenly over the film.
Receivers sort_into_cells(const PerspectiveGrid& grid, const std::vector<ReceiverPoint>& points, std::uint32_t per_cell);

/// Mean luminance of rho; 0 of none.
float mean_reflectance(std::span<const ReceiverPoint> receivers);

/// Up to `wanted` receiver points of the cells around a vertex, spread evenly; the vertex itself when they hold none.
std::vector<ReceiverPoint> receivers_around(const PerspectiveGrid& grid, const Receivers& receivers,
                                            std::uint32_t vertex, std::uint32_t wanted);

}  // namespace radfarm
