#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <thread>

#include "base/progress.h"
#include "cli/progress.h"

namespace radfarm::cli {

/// Shows on stderr how far work of this process is, as Progress shows a job: on a terminal one line, redrawn twice a second
/// so that the time goes on while a phase says nothing; else a line for each new phase.
class PhaseDisplay {
 public:
  /// `state`: what the line begins with.
  PhaseDisplay(Progress::Style style, JobState state);
  /// Draws the last step and ends the line.
  ~PhaseDisplay();
  PhaseDisplay(const PhaseDisplay&) = delete;
  PhaseDisplay& operator=(const PhaseDisplay&) = delete;

  /// A phase of at least `total` steps, or of unknown length when that is 0. Thread-safe.
  void show(std::string_view phase, std::uint64_t done, std::uint64_t total);
  /// Reports here, and is cancelled by `stop`. Not to outlive this object.
  radfarm::Progress progress(std::stop_token stop = {});

 private:
  void redraw();
  void redraw_until(const std::stop_token& ended);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  Progress line_;
  JobStatus status_;
  std::jthread redrawing_;  // the last: it uses the others
};

}  // namespace radfarm::cli
