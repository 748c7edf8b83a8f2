#include "cli/progress.h"

#include <unistd.h>

#include <array>
#include <cstdio>

namespace radfarm::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr std::size_t kPhaseWidth = 40;

std::string verb(JobState state) {
  switch (state) {
    case JobState::kQueued:
      return "queued";
    case JobState::kPreparing:
      return "preparing";
    case JobState::kRendering:
      return "rendering";
    case JobState::kAssembling:
      return "assembling";
    case JobState::kSucceeded:
      return "done";
    case JobState::kFailed:
      return "failed";
    case JobState::kCancelling:
      return "cancelling";
    case JobState::kCancelled:
      return "cancelled";
  }
  return "";
}

/// What is prepared now, with the space that follows it.
std::string phase_text(const JobPhase& phase) {
  if (phase.name.empty()) return "";
  std::string text = phase.name.substr(0, kPhaseWidth);
  if (phase.total > 0 || phase.done > 0) text += " " + std::to_string(phase.done);
  if (phase.total > 0) text += "/" + std::to_string(phase.total);
  return text + "  ";
}

double share(const JobProgress& progress) {
  return progress.tasks_total == 0 ? 0.0 : static_cast<double>(progress.tasks_committed) / progress.tasks_total;
}

}  // namespace

std::string progress_line(const JobStatus& status, double seconds) {
  const JobProgress& progress = status.progress;
  std::array<char, 80> line{};
  if (progress.tasks_total == 0) {
    std::snprintf(line.data(), line.size(), "%-10s %s%.1f s", verb(status.state).c_str(),
                  phase_text(progress.phase).c_str(), seconds);
    return line.data();
  }
  const int full = static_cast<int>(share(progress) * kBarWidth);
  const std::string bar =
      std::string(static_cast<std::size_t>(full), '#') + std::string(static_cast<std::size_t>(kBarWidth - full), '-');
  const std::string round = progress.round > 1 ? "round " + std::to_string(progress.round) + "  " : "";
  std::snprintf(line.data(), line.size(), "%-10s [%s] %s%u/%u tasks  %.1f s", verb(status.state).c_str(), bar.c_str(),
                round.c_str(), progress.tasks_committed, progress.tasks_total, seconds);
  return line.data();
}

Progress::Style Progress::style_for_stderr() { return ::isatty(STDERR_FILENO) == 1 ? Style::kBar : Style::kLines; }

Progress::~Progress() { finish(); }

void Progress::finish() {
  if (!drawn_.empty()) std::fputc('\n', stderr);
  drawn_.clear();
}

void Progress::show(const JobStatus& status) {
  const std::string line = progress_line(status, watch_.wall_seconds());
  if (style_ == Style::kBar) {
    if (line == drawn_) return;
    const std::string blanks(drawn_.size() > line.size() ? drawn_.size() - line.size() : 0, ' ');
    std::fprintf(stderr, "\r%s%s", line.c_str(), blanks.c_str());
    drawn_ = line;
    return;
  }
  const int tenths = static_cast<int>(10 * share(status.progress));
  if (state_ == status.state && tenths_ == tenths && phase_ == status.progress.phase.name) return;
  state_ = status.state;
  tenths_ = tenths;
  phase_ = status.progress.phase.name;
  std::fprintf(stderr, "%s%s%s\n", line.c_str(),
               status.progress.waiting_for.empty() ? "" : "  waiting: ", status.progress.waiting_for.c_str());
}

}  // namespace radfarm::cli
