#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "senders/settings.h"

namespace radfarm {

/// Paper 1's perspective grid: cells are equal steps across the film and equal ratios in depth, fitted to the depths that
/// the camera sees, so that cells stay about as deep as they are wide.                 docs/pipeline.md (senders.1)
struct PerspectiveGrid {
  Camera camera;                // name unused
  float film_aspect = 1;        // width / height
  float film_height = 1;        // pixels
  float near = 1, far = 2;      // m along the view axis
  std::uint32_t columns = 1, rows = 1, slices = 1;

  std::uint32_t cell_count() const { return columns * rows * slices; }
  std::uint32_t vertex_count() const { return (columns + 1) * (rows + 1) * (slices + 1); }
  std::uint32_t vertex_id(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    return (k * (rows + 1) + j) * (columns + 1) + i;
  }
  std::array<std::uint32_t, 3> vertex_indices(std::uint32_t id) const {
    return {id % (columns + 1), id / (columns + 1) % (rows + 1), id / (columns + 1) / (rows + 1)};
  }
  /// The world position of a vertex.
  Vec3 vertex_position(std::uint32_t id) const;
  /// The world position of continuous coordinates, in cells.
  Vec3 position(const Vec3& cells) const;
  /// Cells that touch a vertex: up to 8, fewer at the border.
  std::vector<std::uint32_t> cells_around(std::uint32_t vertex) const;
  /// Continuous coordinates of a point, in cells; points outside are moved to the nearest border.
  Vec3 locate(const Vec3& position) const;
  std::uint32_t cell_at(const Vec3& position) const;
  /// How wide a cell is at the depth of a point, m: what lies closer to the point than that, a vertex cannot know of.
  float cell_width(const Vec3& position) const;
  /// The mean length of a cell's twelve edges, m.
  float mean_edge(std::uint32_t cell) const;
  /// How much of a surface that faces the camera a pixel shows at the depth of a point, m.
  float pixel_width(const Vec3& position) const;
};

/// The four vertices whose values a point interpolates, and their weights, >= 0, that add up to 1: the conforming split of
/// each cell into five tetrahedra (ALGORITHMS 1.1.3), so that neighbours agree on every shared face.
struct Interpolation {
  std::array<std::uint32_t, 4> vertices{};
  std::array<float, 4> weights{};
};
Interpolation interpolate(const PerspectiveGrid& grid, const Vec3& position);

/// The vertex that stands for a point when `choice` in [0, 1) chooses by weight.
std::uint32_t choose_vertex(const Interpolation& interpolation, float choice);

}  // namespace radfarm
