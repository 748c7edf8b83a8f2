#pragma once

#include "senders/surroundings.h"

namespace radfarm {

/// What lines to a sender found.
struct Observation {
  float strength = 0;       // mean of k = cos_y / (pi r^2), 1/m^2; on surfaces the length of its vector sum
  float kernel = 0, kernel_min = 0, kernel_max = 0;  // k; on surfaces times the receiver's cosine
  float visibility = 1;
  float penumbra = 0;       // mean width of the shadows' edges, m; 0: none met
  Vec3 direction{0, 0, 1};
};

/// Lines from random points of the surroundings to the fixed points of a sender. (paper.2), (paper.9)
Observation observe(const VertexContext& context, const Surroundings& around, std::uint32_t sender, std::uint32_t samples,
                    std::uint64_t key);

}  // namespace radfarm
