#include "cli/phase_display.h"

#include <chrono>
#include <string>
#include <utility>

namespace radfarm::cli {
namespace {

constexpr std::chrono::milliseconds kTick{500};

}  // namespace

PhaseDisplay::PhaseDisplay(Progress::Style style, JobState state) : line_(style) {
  status_.state = state;
  redrawing_ = std::jthread([this](const std::stop_token& ended) { redraw_until(ended); });
}

PhaseDisplay::~PhaseDisplay() {
  redrawing_.request_stop();
  redrawing_.join();
  redraw();
}

void PhaseDisplay::show(std::string_view phase, std::uint64_t done, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  const bool is_new = phase != status_.progress.phase.name;
  status_.progress.phase = {std::string(phase), done, total};
  if (is_new) line_.show(status_);
}

radfarm::Progress PhaseDisplay::progress(std::stop_token stop) {
  return radfarm::Progress([this](std::string_view phase, std::uint64_t done, std::uint64_t total) { show(phase, done, total); },
                           std::move(stop));
}

void PhaseDisplay::redraw() {
  if (!status_.progress.phase.name.empty()) line_.show(status_);
}

void PhaseDisplay::redraw_until(const std::stop_token& ended) {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait_for(lock, ended, kTick, [] { return false; });
    if (ended.stop_requested()) return;
    redraw();
  }
}

}  // namespace radfarm::cli
