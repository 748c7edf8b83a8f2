#pragma once

#include <cstdint>

namespace radfarm {

/// What steers the sender classification on the perspective grid and the gather. Depends on the view.
struct SenderSettings {
  float threshold = 0;                  // T: largest accepted change of radiance by interpolating a sender, cd/m^2
  std::uint32_t columns = 24;           // grid cells across, up and in depth
  std::uint32_t rows = 16;
  std::uint32_t slices = 20;
  std::uint32_t max_senders = 400;      // of one vertex: the cut stops there
  std::uint32_t vertex_samples = 1200;  // visibility rays to classify one vertex
  float samples_per_gather = 12;        // visibility rays of one camera sample, over all its senders (a real number)
};

}  // namespace radfarm
