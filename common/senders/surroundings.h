#pragma once

#include <span>
#include <vector>

#include "senders/vertex_senders.h"

namespace radfarm {

/// What a vertex of the paper's gather stands for: the cells around one of the grid, or the patches around one of theirs.
struct Surroundings {
  ReceiverRegion region;
  std::vector<std::uint32_t> cells;
  std::span<const std::uint32_t> patches;  // reflectors; empty in free space
  bool is_on_surface() const { return !patches.empty(); }
};
Surroundings around_grid_vertex(const VertexContext& context, std::uint32_t vertex);
Surroundings around_patch_vertex(const VertexContext& context, std::uint32_t vertex);

/// A random point of them: in free space by the cells' coordinates, without a normal; or of one of the patches, with its own.
/// docs/pipeline.md (paper.2), (paper.9)
ReceiverPoint random_receiver(const VertexContext& context, const Surroundings& around, std::uint64_t key);

/// What is above a patch.
struct HalfSpace {
  Vec3 normal{0, 0, 1};
  float height = 0;  // along the normal, m: a ray's offset above the patch
};
std::vector<HalfSpace> half_spaces(const VertexContext& context, const Surroundings& around);

/// Whether all of a box lies below all of the patches. False in free space.
bool is_below(const std::vector<HalfSpace>& half_spaces, const Box3& box);

}  // namespace radfarm
