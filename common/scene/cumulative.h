#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace radfarm {

struct CumulativePosition {
  std::size_t index = 0;
  double share = 0;        // of the way through that item, [0, 1]: uniform again when u was
  double probability = 0;  // of the item
};

/// The item of a list of running sums in which u of the total lies, u in [0, 1); never one that adds nothing.
/// Requires: sums.back() > 0.
inline CumulativePosition find_in_sums(std::span<const double> sums, double u) {
  const double target = u * sums.back();
  auto it = std::upper_bound(sums.begin(), sums.end(), target);
  if (it == sums.end()) it = std::lower_bound(sums.begin(), sums.end(), sums.back());
  const double before = it == sums.begin() ? 0 : *(it - 1);
  const double share = std::clamp((target - before) / (*it - before), 0.0, 1.0);
  return {static_cast<std::size_t>(it - sums.begin()), share, (*it - before) / sums.back()};
}

}  // namespace radfarm
