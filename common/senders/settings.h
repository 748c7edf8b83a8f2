#pragma once

#include <cstdint>

namespace radfarm {

/// How the gather works: as built here, or as paper 1 has it.
enum class Gather : std::uint32_t { kDefault = 0, kPaper = 1 };

/// What steers the sender classification on the perspective grid and the gather. Depends on the view.
struct SenderSettings {
  // T: largest accepted change of radiance by interpolating a sender. So many just visible differences of the displayed image, by
  // pixel (masking.5); or, where that is 0, the same everywhere, cd/m^2.
  float threshold_scale = 0;
  float threshold = 0;
  float max_elevation = 1;              // of the threshold by detail, at most; 1: masking is off
  std::uint32_t columns = 24;           // grid cells across, up and in depth
  std::uint32_t rows = 16;
  std::uint32_t slices = 20;
  std::uint32_t max_senders = 400;      // of one vertex: the cut stops there
  std::uint32_t vertex_samples = 1200;  // visibility rays to classify one vertex
  float samples_per_gather = 2;         // lines of one camera sample, over all its senders (a real number)
  std::uint32_t sky_lines = 2;          // of one camera sample, where there is a sky
  std::uint32_t reflected_rays = 2;     // of one camera sample, to the radiosity solution
  std::uint32_t next_events = 0;        // 1: where these end, light straight from emitters is sampled again
  Gather gather = Gather::kDefault;
  float paper_samples = 144;            // paper: sample points of all senders at one point, N of its eq. 1
};

}  // namespace radfarm
