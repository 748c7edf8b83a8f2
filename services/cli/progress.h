#pragma once

#include <optional>
#include <string>

#include "base/stopwatch.h"
#include "rpc/messages.h"

namespace radfarm::cli {

/// Shows how a job goes on stderr: one line that is redrawn on a terminal, else a line for each new state, phase
/// of the preparation and tenth.
class Progress {
 public:
  enum class Style { kBar, kLines };
  explicit Progress(Style style) : style_(style) {}
  /// kBar when stderr is a terminal.
  static Style style_for_stderr();
  ~Progress();

  void show(const JobStatus& status);
  /// Ends the redrawn line, so that other output starts on a line of its own.
  void finish();

 private:
  const Style style_;
  Stopwatch watch_;
  std::string drawn_;
  std::optional<JobState> state_;
  std::string phase_;
  int tenths_ = -1;
};

/// "rendering [######------]  12/24 tasks  3.1 s" or "preparing  radiosity: links 512/20480  0.9 s", at most 79 columns.
std::string progress_line(const JobStatus& status, double seconds);

}  // namespace radfarm::cli
