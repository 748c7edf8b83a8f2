#pragma once

#include "senders/closed_components.h"
#include "senders/patch_mesh.h"
#include "senders/vertex_senders.h"

namespace radfarm {

/// What the paper's classification needs of a view besides a VertexContext. Borrows world and tree.
struct PaperContext {
  PaperContext(const World& world, const SenderTree& tree, const PerspectiveGrid& grid);

  ReflectorLookup lookup;
  ClosedComponents closed;
  std::vector<std::uint32_t> parents;  // of each node of the tree; kNone of the root
  PatchMesh patches;
};

/// The classification of one vertex as Scheel, Stamminger and Seidel have it [1]: eq. 1 to 3 literally, lines from random
/// points in free space in the cells around, the hit-count rule, clusters around the vertex by 100 rays, numbers of samples
/// by contrast and penumbra. docs/pipeline.md (paper.1) to (paper.4) Requires: context.paper. Pure. For comparison: it misses
/// what the default measures (docs/pipeline.md, Paper 1 to the letter).
VertexSenders paper_vertex(const VertexContext& context, std::uint32_t vertex);

/// The same of a vertex of context.paper->patches: lines from points of the patches around, with the receiver's cosine, that
/// their first hit hides. docs/pipeline.md (paper.9)
VertexSenders paper_patch_vertex(const VertexContext& context, std::uint32_t vertex);

}  // namespace radfarm
