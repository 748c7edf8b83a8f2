#pragma once

#include <cstdint>

#include "base/status.h"
#include "estimate/sample_budget.h"
#include "estimate/settings.h"

namespace radfarm {

/// A job that has a target is rendered in at most so many rounds, and again when it is extended.
inline constexpr std::uint32_t kMostRounds = 4;

/// What one round of a job adds to what a view's settings say. Rounds under one view count from its first sample: tasks go on
/// from what they returned before, and the image is, bit by bit, that of a render that took all at once with the last scale.
struct Round {
  std::uint32_t number = 0;         // of the job, from 0: keys the audit, so that each round's pixels and paths are fresh
  std::uint32_t audit_pixels = 0;   // about; 0: no audit
  std::uint32_t audit_samples = 0;  // paths of each of the two estimates of one
  double scale = 1;                 // of the samples that the settings give pixels (SampleBudget), and of light paths; at least 1
  friend bool operator==(const Round&, const Round&) = default;
};

/// As the settings have it.
inline Round first_round(const Settings& settings) { return {0, settings.audit_pixels, settings.audit_samples, 1}; }

/// INVALID_ARGUMENT unless it can be run: it may come from the network.
Status check(const Round& round);

SampleBudget budget_of(const Settings& settings, const Round& round);

/// How often each photon task follows its share of the view's light paths, with fresh ones each time.
std::uint32_t photon_passes(const Round& round);

/// What the audit's pixels and random numbers are keyed by; of the first round the settings' own seed.
std::uint64_t audit_seed(const Settings& settings, const Round& round);

}  // namespace radfarm
