#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/effort.h"
#include "pipeline/round_figures.h"

namespace radfarm {

/// What may be done for a job that has a target.
struct RoundsAsked {
  Target target;
  bool may_trace_paths = false;   // whether the integrator is ours to choose: path tracing where no finer light helps
  std::uint32_t rounds_left = 0;  // after the one that was assembled last
  double seconds_left = 0;        // until a target of seconds is over: the caller's clock
  double assembly_seconds = 0;    // that the end of a round takes
};

/// What comes after a round.
struct NextRound {
  enum class Step : std::uint32_t { kStop, kMoreSamples, kNewLight } step = Step::kStop;
  std::optional<bool> target_met;  // where it stops; nothing without a target of error, or of a black image
  Round round;                     // of the other two
  Effort effort;                   // of new light
};

/// Decides what comes after the last of `rounds` (all of the job so far): stop where the audit's upper bound is below the target,
/// or where nothing is left to try; more samples where noise is what is wrong; new light where bias is. Pure: no clock, and but
/// for a target of seconds nothing that a clock measured, so a target of error gives the same image everywhere.
/// Requires: a target, and at least one round.                                   docs/accuracy.md (rounds.1) to (rounds.4)
NextRound next_round(const RoundsAsked& asked, std::span<const RoundFigures> rounds);

/// What halving the error of a job would cost, on top of what it took.
struct NextHalving {
  double cpu_seconds = 0;
  double wall_seconds = 0;
  const char* from = "";  // what it is predicted by
};

/// By the noise that samples would leave; where bias is in the way, by the slope of error against CPU time between the first and
/// the last round, or else assumed to be that of noise. Nothing where no error was measured or no time taken.
std::optional<NextHalving> next_halving(std::span<const RoundFigures> rounds);

}  // namespace radfarm
