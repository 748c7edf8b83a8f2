#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/world.h"
#include "senders/sender_tree.h"

namespace radfarm {

/// Finds the sender on which a ray ends. Borrows the tree.
class SenderLookup {
 public:
  /// O(senders log senders).
  SenderLookup(const World& world, const SenderTree& tree);

  /// The undivided sender patch at a surface point, by the side that `point` shows; kNone where nothing is sent. O(log senders).
  std::uint32_t find(const Hit& hit, const SurfacePoint& point) const;

 private:
  std::uint64_t key_of(std::uint32_t instance, std::uint32_t triangle, bool is_front) const;

  const SenderTree* tree_;
  std::vector<std::uint64_t> first_triangle_;  // one an instance
  std::vector<std::uint64_t> keys_;            // sides, ascending, one a node of nodes_
  std::vector<std::uint32_t> nodes_;
};

}  // namespace radfarm
