#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>

#include "base/status.h"
#include "rpc/messages.h"

namespace radfarm::cli {

/// What a waiting command learns from elsewhere: signals, children, the watched job. Thread-safe.
class Events {
 public:
  struct Seen {
    bool interrupted = false;      // SIGINT or SIGTERM came, ever
    bool child_ended = false;      // some child ended since the last look
    std::optional<JobStatus> job;  // the newest state since the last look
    std::optional<Error> lost;     // the watch ended with an error
    bool timed_out = false;
  };

  void interrupt();
  void child_ended();
  void job(const JobStatus& status);
  void lose(const Error& error);
  /// What was heard of a job is nothing to the next one.
  void forget_job();

  /// What happened since the last look; waits for something to happen, until `deadline`.
  Seen wait(std::optional<std::chrono::steady_clock::time_point> deadline);
  /// Is stopped by interrupt().
  std::stop_token interruption() const { return stop_.get_token(); }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Seen seen_;
  bool fresh_ = false;
  std::stop_source stop_;
};

}  // namespace radfarm::cli
