#pragma once

#include <cstdint>

namespace radfarm {

/// What a task counted; sums over tasks enter the report. Eight-byte members only: the struct is stored as it is.
struct Counters {
  std::uint64_t camera_rays = 0;
  std::uint64_t visibility_rays = 0;
  std::uint64_t path_rays = 0;            // closest-hit rays after the first
  std::uint64_t form_factor_samples = 0;
  std::uint64_t photon_paths = 0;
  std::uint64_t dropped_samples = 0;      // not finite or negative: left out of the mean, and reported
  std::uint64_t vertices_computed = 0;    // grid vertices that the prepass did not meet

  Counters& operator+=(const Counters& o) {
    camera_rays += o.camera_rays;
    visibility_rays += o.visibility_rays;
    path_rays += o.path_rays;
    form_factor_samples += o.form_factor_samples;
    photon_paths += o.photon_paths;
    dropped_samples += o.dropped_samples;
    vertices_computed += o.vertices_computed;
    return *this;
  }
  friend bool operator==(const Counters&, const Counters&) = default;
};

}  // namespace radfarm
