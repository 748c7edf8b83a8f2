#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/world.h"
#include "senders/sender_tree.h"

namespace radfarm {

/// Finds the reflector on which a ray ends. Borrows the tree.
class ReflectorLookup {
 public:
  /// O(reflectors log reflectors).
  ReflectorLookup(const World& world, const SenderTree& tree);

  /// The index in SenderTree::reflectors of what a surface point is a part of, by the side that `point` shows; kNone where
  /// nothing comes by rays. O(log reflectors).
  std::uint32_t find(const Hit& hit, const SurfacePoint& point) const;
  const SenderTree& tree() const { return *tree_; }

 private:
  std::uint64_t key_of(std::uint32_t instance, std::uint32_t triangle, bool is_front) const;

  const SenderTree* tree_;
  std::vector<std::uint64_t> first_triangle_;  // one an instance
  std::vector<std::uint64_t> keys_;            // sides, ascending, one a number of order_
  std::vector<std::uint32_t> order_;           // reflectors by side
};

}  // namespace radfarm
