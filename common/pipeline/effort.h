#pragma once

#include <optional>

namespace radfarm {

/// What a job is asked for besides a quality; both 0: nothing.
struct Target {
  double error = 0;    // relative: .02 is 2 %
  double seconds = 0;  // of wall time, from the start of the preparation
  bool is_set() const { return error > 0 || seconds > 0; }
  friend bool operator==(const Target&, const Target&) = default;
};

/// How much goes into a view's light, where rounds of a job have decided it.
struct Effort {
  std::optional<float> level;  // Settings::level; nothing: by the request and the pilot
  bool by_paths = false;       // path tracing, as no finer light would do
  int threads = 1;             // of all workers, that a target of seconds is shared out over
  friend bool operator==(const Effort&, const Effort&) = default;
};

/// From the resolution of a preview, 0, to a reference's, 3.
inline constexpr float kMostLevel = 3;

}  // namespace radfarm
