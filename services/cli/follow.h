#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "cli/events.h"
#include "cli/farm_client.h"
#include "cli/progress.h"

namespace radfarm::cli {

struct FollowOptions {
  std::optional<std::chrono::steady_clock::time_point> deadline;
  enum class OnInterrupt { kCancelJob, kLeaveJob } on_interrupt = OnInterrupt::kLeaveJob;
  std::function<Status()> check_children;  // asked when a child has ended; may be empty
};

/// Watches a job until it is terminal; the last state. CANCELLED when interrupted, DEADLINE_EXCEEDED after the
/// deadline, or what check_children says.
Result<JobStatus> follow(FarmClient& client, const std::string& id, const FollowOptions& options, Events& events,
                         Progress& progress);

}  // namespace radfarm::cli
