#pragma once

#include <cstdint>

namespace radfarm {

/// What is leased, retried and committed: a piece of a job that any worker computes to the same bits.
struct Task {
  enum class Kind : std::uint32_t { kTile = 0, kAudit = 1, kPhotons = 2 };
  Kind kind = Kind::kTile;
  std::uint32_t index = 0;
  friend bool operator==(const Task&, const Task&) = default;
};

}  // namespace radfarm
