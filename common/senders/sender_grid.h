#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/status.h"
#include "senders/patch_mesh.h"
#include "senders/vertex_senders.h"
#include "senders/vertex_thresholds.h"

namespace radfarm {

/// What the coordinator leaves of the sender stage: the grid, the receivers, and the vertices that the prepass touched.
struct SenderGridFile {
  PerspectiveGrid grid;
  Receivers receivers;
  std::vector<std::uint32_t> vertices;   // ascending ids
  std::vector<VertexSenders> senders;    // one of `vertices` each
  std::vector<float> thresholds;         // T, cd/m^2, one a vertex of the grid
};

/// The classified grid, and what the thresholds came from; where one is given for all, their means only.
struct ClassifiedView {
  SenderGridFile file;
  VertexThresholds perception;  // its values are the file's
  double seen_radiance = 0;     // reflected, mean over visible points by the radiosity solution, cd/m^2
};

/// Prepass, grid, thresholds, and the classification of every vertex that a visible point interpolates, on all threads.
ClassifiedView classify_visible(const World& world, const SenderTree& tree, const Camera& camera, int width, int height,
                                const SenderSettings& settings, std::uint64_t seed, const Progress& progress = {});

[[nodiscard]] std::vector<std::byte> encode(const SenderGridFile& file);
/// `camera` comes from the view that holds the grid, `sky_patches` is how many the environment has. Hostile bytes give DATA_LOSS.
Result<SenderGridFile> decode_sender_grid(std::span<const std::byte> bytes, const Camera& camera,
                                          const SenderTree& tree, std::size_t sky_patches);

/// The senders of any vertex: those of the file, others computed when first asked for. Thread-safe.
class SenderGrid {
 public:
  /// Borrows world, tree and settings.
  SenderGrid(SenderGridFile file, const World& world, const SenderTree& tree, const SenderSettings& settings,
             std::uint64_t seed);
  ~SenderGrid();
  SenderGrid(const SenderGrid&) = delete;
  SenderGrid& operator=(const SenderGrid&) = delete;

  const PerspectiveGrid& grid() const { return grid_; }
  const VertexSenders& at(std::uint32_t vertex) const;
  /// The patches that the paper's gather interpolates on; nullptr for the default. (paper.8)
  const PatchMesh* patches() const;
  /// The senders of a vertex of patches(), computed when first asked for.
  const VertexSenders& at_patch_vertex(std::uint32_t vertex) const;
  /// The largest change of radiance that its classification accepts, cd/m^2.
  float threshold_at(std::uint32_t vertex) const { return thresholds_[vertex]; }
  /// Vertices of the grid that were not in the file and have been computed here so far.
  std::uint64_t computed() const { return computed_.load(std::memory_order_relaxed); }

 private:
  PerspectiveGrid grid_;
  Receivers receivers_;
  std::vector<float> thresholds_;
  std::unique_ptr<const PaperContext> paper_;  // of the paper's gather alone
  VertexContext context_;
  // One slot a vertex, filled at most once. Two threads that fill the same slot compute the same bits; one result stays.
  mutable std::vector<std::atomic<const VertexSenders*>> slots_;
  mutable std::vector<std::atomic<const VertexSenders*>> patch_slots_;  // one a vertex of patches()
  mutable std::atomic<std::uint64_t> computed_ = 0;
};

}  // namespace radfarm
