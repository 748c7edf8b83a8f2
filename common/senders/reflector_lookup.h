#pragma once

#include <cstdint>
#include <vector>

#include "scene/world.h"
#include "senders/sender_tree.h"

namespace radfarm {

/// Finds the reflector on which a ray ends. Borrows world and tree.
class ReflectorLookup {
 public:
  /// O(reflectors log reflectors).
  ReflectorLookup(const World& world, const SenderTree& tree);

  /// The index in SenderTree::reflectors of what a surface point is a part of, by the side that `point` shows; kNone where
  /// nothing is reflected. O(log reflectors).
  std::uint32_t find(const Hit& hit, const SurfacePoint& point) const;

  const SenderTree& tree() const { return *tree_; }

 private:
  /// A reflector among those of its triangle's side, by the codes of the side's quadtree that it covers.
  struct Place {
    std::uint32_t side = 0;
    std::uint32_t first_code = 0;
    std::uint32_t codes = 0;
    std::uint32_t reflector = 0;
  };
  static constexpr std::uint32_t kAllCodes = 1U << 30;  // of a whole side

  const World* world_;
  const SenderTree* tree_;
  SideNumbers sides_;
  std::vector<Place> places_;  // by side, then code
};

}  // namespace radfarm
