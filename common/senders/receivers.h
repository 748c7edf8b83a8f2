#pragma once

#include <cstdint>
#include <vector>

#include "scene/world.h"
#include "senders/grid.h"

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

/// What a camera sees: one receiver point a film sample that hits something.
std::vector<ReceiverPoint> find_visible_points(const World& world, const Camera& camera, int width, int height,
                                               std::uint32_t samples, std::uint64_t seed);

/// A grid over the depths of the points, a little wider.
PerspectiveGrid fit_grid(const Camera& camera, int width, int height, const std::vector<ReceiverPoint>& points,
                         const SenderSettings& settings);

/// Sorts the points into the grid's cells and keeps at most `per_cell` of each, spread evenly over the film.
Receivers sort_into_cells(const PerspectiveGrid& grid, const std::vector<ReceiverPoint>& points, std::uint32_t per_cell);

/// Up to `wanted` receiver points of the cells around a vertex, spread evenly; the vertex itself when they hold none.
std::vector<ReceiverPoint> receivers_around(const PerspectiveGrid& grid, const Receivers& receivers,
                                            std::uint32_t vertex, std::uint32_t wanted);

}  // namespace radfarm
