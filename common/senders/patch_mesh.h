#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/world.h"
#include "senders/grid.h"
#include "senders/sender_tree.h"

namespace radfarm {

/// Patches on which the paper's gather interpolates instead of in the grid's tetrahedra, and their vertices. A vertex belongs
/// to all such patches with a corner at its position, in every bit, that face one way within 10 degrees: neighbours share it.
/// Where a neighbour is coarser or is gathered on the grid, light may step. docs/pipeline.md (paper.8)
struct PatchMesh {
  std::vector<std::array<std::uint32_t, 3>> corners;  // vertices of each reflector of the tree; kNone: gathered on the grid
  std::vector<std::uint32_t> first_around;            // one a vertex and one past the last
  std::vector<std::uint32_t> reflectors_around;       // those around vertex v are [first_around[v], first_around[v + 1])

  bool has(std::uint32_t reflector) const { return reflector != kNone && corners[reflector][0] != kNone; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(first_around.size() - 1); }
  std::span<const std::uint32_t> around(std::uint32_t vertex) const {
    return std::span(reflectors_around).subspan(first_around[vertex], first_around[vertex + 1] - first_around[vertex]);
  }
};

/// (paper.8) The switch [1, 4.5; ALGORITHMS A10]: radiosity cut the patch from a larger triangle, or its longest edge is not
/// shorter than the mean edge of the cell that holds its centroid. What is left to the grid are whole triangles smaller than a
/// cell: links may have come to their clusters only.
bool is_gathered_on(const World& world, const Reflector& patch, const PerspectiveGrid& grid);

/// O(reflectors log reflectors). Deterministic.
PatchMesh make_patch_mesh(const World& world, const SenderTree& tree, const PerspectiveGrid& grid);

/// The weights of a patch's corners at a position of it: >= 0, adding up to 1.
std::array<float, 3> corner_weights(const TriangleVertices& patch, const Vec3& position);

}  // namespace radfarm
