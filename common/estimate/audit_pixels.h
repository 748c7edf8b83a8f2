#pragma once

#include <cstdint>
#include <vector>

namespace radfarm {

/// A pixel chosen for the audit and the share of the image that it stands for.
struct AuditPixel {
  int x = 0;
  int y = 0;
  double weight = 0;  // sums to 1 over all audited pixels
};

/// About `wanted` pixels, one at a uniformly random place in each cell of a lattice over the image: stratified, so that
/// every region is looked at. Depends only on the arguments. O(wanted).
std::vector<AuditPixel> choose_audit_pixels(int width, int height, std::uint32_t wanted, std::uint64_t seed);

}  // namespace radfarm
