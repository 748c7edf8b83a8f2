#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "base/status.h"

namespace radfarm::rpc {

/// How long a call is repeated while the server is UNAVAILABLE, the only code that is ever retried.
struct RetryPolicy {
  std::chrono::milliseconds first_wait{50};
  std::chrono::milliseconds longest_wait{2000};
  std::chrono::milliseconds give_up_after{20000};
};

/// Waits between attempts; returns false when the caller should stop trying (it is being shut down).
using Pause = std::function<bool(std::chrono::milliseconds)>;

/// The wait before attempt number `attempt` (1 is the first repetition): doubles from first_wait to longest_wait, and
/// is scattered over its upper half by `random_bits` so that a thousand workers do not return in one moment.
std::chrono::milliseconds backoff(const RetryPolicy& policy, int attempt, std::uint64_t random_bits);

/// Calls `call` until it answers anything but UNAVAILABLE, the policy gives up, or `pause` says to stop; the last
/// answer. Requires: `call` may be repeated safely.
Status with_retries(const RetryPolicy& policy, const Pause& pause, const std::function<Status()>& call);

/// The same with a pause that just waits.
Status with_retries(const RetryPolicy& policy, const std::function<Status()>& call);

}  // namespace radfarm::rpc
