#include "rpc/retry.h"

#include <algorithm>
#include <random>
#include <thread>

namespace radfarm::rpc {

std::chrono::milliseconds backoff(const RetryPolicy& policy, int attempt, std::uint64_t random_bits) {
  const int doublings = std::clamp(attempt - 1, 0, 20);
  const auto full = std::min(policy.first_wait * (std::int64_t{1} << doublings), policy.longest_wait);
  const auto half = std::max<std::int64_t>(full.count() / 2, 1);
  return std::chrono::milliseconds(half + static_cast<std::int64_t>(random_bits % static_cast<std::uint64_t>(half)));
}

Status with_retries(const RetryPolicy& policy, const Pause& pause, const std::function<Status()>& call) {
  std::random_device random;
  std::chrono::milliseconds waited{0};
  for (int attempt = 1;; ++attempt) {
    Status status = call();
    if (status || status.error().code != Code::kUnavailable) return status;
    const auto wait = backoff(policy, attempt, random());
    waited += wait;
    if (waited > policy.give_up_after || !pause(wait)) return status;
  }
}

Status with_retries(const RetryPolicy& policy, const std::function<Status()>& call) {
  const auto sleep = [](std::chrono::milliseconds wait) {
    std::this_thread::sleep_for(wait);
    return true;
  };
  return with_retries(policy, sleep, call);
}

}  // namespace radfarm::rpc
