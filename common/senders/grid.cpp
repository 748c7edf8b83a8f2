#include "senders/grid.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

/// Half the film's size at distance z.
Vec2 half_extent(const PerspectiveGrid& grid, float z) {
  const bool is_perspective = grid.camera.kind == Camera::Kind::kPerspective;
  const float half_height = is_perspective ? z * std::tan(grid.camera.vertical_fov / 2) : grid.camera.half_height;
  return {half_height * grid.film_aspect, half_height};
}

float depth_of_slice(const PerspectiveGrid& grid, float k) {
  return grid.near * std::pow(grid.far / grid.near, k / static_cast<float>(grid.slices));
}

float slice_of_depth(const PerspectiveGrid& grid, float z) {
  return static_cast<float>(grid.slices) * std::log(std::max(z, grid.near) / grid.near) /
         std::log(grid.far / grid.near);
}

}  // namespace

Vec3 PerspectiveGrid::vertex_position(std::uint32_t id) const {
  const auto [i, j, k] = vertex_indices(id);
  return position({static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)});
}

Vec3 PerspectiveGrid::position(const Vec3& cells) const {
  const float z = depth_of_slice(*this, cells.z);
  const Vec2 half = half_extent(*this, z);
  const float x = (2 * cells.x / static_cast<float>(columns) - 1) * half.x;
  const float y = (1 - 2 * cells.y / static_cast<float>(rows)) * half.y;
  return camera.position + camera.right * x + camera.up * y + camera.forward * z;
}

std::vector<std::uint32_t> PerspectiveGrid::cells_around(std::uint32_t vertex) const {
  const auto [i, j, k] = vertex_indices(vertex);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    // One step back along each axis or none. Unsigned wrap-around fails the bound.
    const std::uint32_t x = i - (corner & 1U), y = j - ((corner >> 1U) & 1U), z = k - (corner >> 2U);
    if (x < columns && y < rows && z < slices) cells.push_back((z * rows + y) * columns + x);
  }
  return cells;
}

Vec3 PerspectiveGrid::locate(const Vec3& position) const {
  const Vec3 offset = position - camera.position;
  const float z = std::max(offset.dot(camera.forward), near);
  const Vec2 half = half_extent(*this, z);
  const auto place = [](float unit, std::uint32_t cells) {
    return std::clamp(unit, 0.0F, 1.0F) * static_cast<float>(cells);
  };
  return {place((offset.dot(camera.right) / half.x + 1) / 2, columns),
          place((1 - offset.dot(camera.up) / half.y) / 2, rows),
          place(slice_of_depth(*this, z) / static_cast<float>(slices), slices)};
}

std::uint32_t PerspectiveGrid::cell_at(const Vec3& position) const {
  const Vec3 at = locate(position);
  const auto cell = [](float coordinate, std::uint32_t cells) {
    return std::min(static_cast<std::uint32_t>(coordinate), cells - 1);
  };
  return (cell(at.z, slices) * rows + cell(at.y, rows)) * columns + cell(at.x, columns);
}

float PerspectiveGrid::pixel_width(const Vec3& position) const {
  const float z = std::clamp(dot(position - camera.position, camera.forward), near, far);
  return 2 * half_extent(*this, z).y / film_height;
}

float PerspectiveGrid::cell_width(const Vec3& position) const {
  const float z = std::clamp(dot(position - camera.position, camera.forward), near, far);
  return 2 * half_extent(*this, z).x / static_cast<float>(columns);
}

float PerspectiveGrid::mean_edge(std::uint32_t cell) const {
  const std::uint32_t i = cell % columns, j = cell / columns % rows, k = cell / columns / rows;
  std::array<Vec3, 8> corners;
  for (std::uint32_t c = 0; c < 8; ++c) {
    corners[c] = vertex_position(vertex_id(i + (c & 1U), j + ((c >> 1U) & 1U), k + (c >> 2U)));
  }
  float sum = 0;
  for (std::uint32_t c = 0; c < 8; ++c) {
    for (std::uint32_t axis = 1; axis < 8; axis <<= 1) {
      if ((c & axis) == 0) sum += length(corners[c | axis] - corners[c]);
    }
  }
  return sum / 12;
}

Interpolation interpolate(const PerspectiveGrid& grid, const Vec3& position) {
  const Vec3 at = grid.locate(position);
  const std::array<std::uint32_t, 3> cells = {grid.columns, grid.rows, grid.slices};
  std::array<std::uint32_t, 3> base{};
  std::array<float, 3> local{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    base[a] = std::min(static_cast<std::uint32_t>(at[axis]), cells[a] - 1);
    local[a] = at[axis] - static_cast<float>(base[a]);
  }
  // Corners are odd or even by the parity of their global indices, so cells that share a face share its diagonal.
  const std::uint32_t parity = (base[0] + base[1] + base[2]) & 1U;
  const auto id = [&](std::uint32_t corner) {
    return grid.vertex_id(base[0] + (corner & 1U), base[1] + ((corner >> 1U) & 1U), base[2] + (corner >> 2U));
  };
  const auto distance = [&](std::uint32_t corner) {  // L1, in cells
    float sum = 0;
    for (std::uint32_t a = 0; a < 3; ++a) sum += ((corner >> a) & 1U) != 0 ? 1 - local[a] : local[a];
    return sum;
  };
  const auto is_odd = [&](std::uint32_t corner) {
    return (((corner & 1U) + ((corner >> 1U) & 1U) + (corner >> 2U) + parity) & 1U) != 0;
  };
  Interpolation result;
  std::size_t next = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    if (!is_odd(corner)) continue;
    const float d = distance(corner);
    if (d < 1) {  // the corner tetrahedron of an odd corner: itself and its three neighbours along the edges
      result.vertices = {id(corner), id(corner ^ 1U), id(corner ^ 2U), id(corner ^ 4U)};
      result.weights[0] = 1 - d;
      for (std::uint32_t a = 0; a < 3; ++a) {
        result.weights[a + 1] = ((corner >> a) & 1U) != 0 ? 1 - local[a] : local[a];
      }
      return result;
    }
    // The middle tetrahedron of the four even corners: each is weighed by the odd corner across the cell.
    result.vertices[next] = id(corner ^ 7U);
    result.weights[next++] = (d - 1) / 2;
  }
  return result;
}

std::uint32_t choose_vertex(const Interpolation& interpolation, float choice) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (choice < interpolation.weights[i]) return interpolation.vertices[i];
    choice -= interpolation.weights[i];
  }
  return interpolation.vertices[3];
}

}  // namespace radfarm
