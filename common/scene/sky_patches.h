#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/latlong.h"

namespace radfarm {

/// Texels of an environment map: rows and columns from `begin` to before `end`.
struct TexelRect {
  std::uint32_t row_begin = 0, row_end = 0;
  std::uint32_t column_begin = 0, column_end = 0;
};

/// An environment map cut into rectangles of texels: first in halves until none spans more than a patch of Tregenza's
/// sky (1987), then the brightest at the median of their power [Debevec 2005] until none has more than a 256th of the
/// power. Rectangles without light are left out. O(texels) to build, O(log rectangles) to find one.
class PatchTree {
 public:
  PatchTree() = default;
  /// `power` of each texel's cell, row by row: lm for each m^2 facing it.
  PatchTree(const LatLongMap& map, std::span<const double> power);

  std::span<const TexelRect> rects() const { return rects_; }
  /// The rectangle of a texel as an index into rects(), kNone when it is dark.
  std::uint32_t find(const LatLongMap::Texel& texel) const;

 private:
  friend class PatchCutter;
  struct Node {
    bool by_row = false;
    std::uint32_t cut = 0;           // first row or column of the second child; 0 in a leaf
    std::uint32_t children = kNone;  // the first of two nodes; in a leaf the rectangle
  };
  std::vector<Node> nodes_;
  std::vector<TexelRect> rects_;
};

}  // namespace radfarm
