#include "cli/events.h"

#include <utility>

namespace radfarm::cli {

void Events::interrupt() {
  stop_.request_stop();
  const std::lock_guard lock(mutex_);
  seen_.interrupted = fresh_ = true;
  changed_.notify_all();
}

void Events::child_ended() {
  const std::lock_guard lock(mutex_);
  seen_.child_ended = fresh_ = true;
  changed_.notify_all();
}

void Events::job(const JobStatus& status) {
  const std::lock_guard lock(mutex_);
  seen_.job = status;
  fresh_ = true;
  changed_.notify_all();
}

void Events::lose(const Error& error) {
  const std::lock_guard lock(mutex_);
  seen_.lost = error;
  fresh_ = true;
  changed_.notify_all();
}

void Events::forget_job() {
  const std::lock_guard lock(mutex_);
  seen_.job.reset();
  seen_.lost.reset();
}

Events::Seen Events::wait(std::optional<std::chrono::steady_clock::time_point> deadline) {
  std::unique_lock lock(mutex_);
  bool in_time = true;
  if (deadline) {
    in_time = changed_.wait_until(lock, *deadline, [&] { return fresh_; });
  } else {
    changed_.wait(lock, [&] { return fresh_; });
  }
  Seen seen = seen_;
  seen.timed_out = !in_time;
  seen_.child_ended = false;
  seen_.job.reset();
  fresh_ = false;
  return seen;
}

}  // namespace radfarm::cli
