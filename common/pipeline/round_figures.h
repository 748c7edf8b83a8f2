#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "estimate/settings.h"
#include "frame/audit.h"
#include "frame/round.h"

namespace radfarm {

/// What noise samples would leave at a scale.
struct NoiseAt {
  double scale = 1;
  double noise = 0;    // variance of pixels, mean over the image, as a share of its mean squared
  double samples = 0;  // camera samples a pixel, mean over the image; of photon paths, passes
  friend bool operator==(const NoiseAt&, const NoiseAt&) = default;
};

/// What is known of a round once it is assembled: what the next one is decided by, and what the report shows.
struct RoundFigures {
  enum class Kind : std::uint32_t { kFirst, kMoreSamples, kNewLight };
  Kind kind = Kind::kFirst;
  Round round;
  Settings::Integrator integrator = Settings::Integrator::kGather;
  float level = 1;
  float target_error = 0;            // that its view's settings were chosen for
  std::uint32_t pixels = 0;
  std::optional<Accuracy> accuracy;  // nothing: not audited
  std::vector<NoiseAt> noise;        // [0] as it is, then at ever larger scales
  double light_work = 0;             // all samples under this light, in rays of a path tracer, about
  double audit_work = 0;             // this audit, in the same

  // What the farm measured, of this round alone:
  double prepare_cpu_seconds = 0, prepare_wall_seconds = 0;  // 0 unless its light is new
  double light_cpu_seconds = 0, audit_cpu_seconds = 0, wall_seconds = 0;
};

}  // namespace radfarm
