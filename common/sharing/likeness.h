#pragma once

#include <array>
#include <vector>

#include "sharing/planes.h"

namespace radfarm {

/// Pixels [x0, x1) x [y0, y1) that are worked on together.
struct PixelBlock {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t lanes() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
};

/// How like the pixels of a block are to those at one offset from them.                     docs/pipeline.md (sharing.2)
class Likeness {
 public:
  Likeness(const Planes& planes, const PixelBlock& block);

  /// Goes to the neighbours at (dx, dy): `surface` and `features` are theirs from now on.
  void move_to(int dx, int dy);
  /// exp(-surface - light), about: `light` by how a half's light differs from the neighbours' over patches, beyond what noise
  /// explains. One a lane; 0 where a pixel does not share.
  void weigh(const Planes::Part& part, int half, std::vector<float>& weights);

  /// The neighbours against the pixel: place along the surface (two, in windows), normal (two, in tolerances). One a lane.
  const std::array<std::vector<float>, 4>& features() const { return features_; }

 private:
  void compare_light(const Planes::Part& part, int half);

  const Planes& planes_;
  PixelBlock block_;
  int dx_ = 0, dy_ = 0;
  std::array<std::vector<float>, 9> frames_;    // tangent, bitangent, normal of each lane
  std::vector<float> surface_;                  // exponent; kFarthest where either does not share
  std::array<std::vector<float>, 4> features_;
  std::vector<float> distance_, counts_, along_, counts_along_;  // over the block and kPatchRadius about it
};

}  // namespace radfarm
