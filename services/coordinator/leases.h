#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "rpc/messages.h"

namespace radfarm {

using Time = std::chrono::steady_clock::time_point;

struct LeasePolicy {
  std::chrono::milliseconds length{60000};
  int task_failures = 3;  // of one task that fail the job
  int losses = 10;        // attempts of one task whose worker fell silent that fail the job
};

/// Who runs which task of one job. A plain state machine: the caller holds the lock, passes the time and random tokens
/// in.
///
///     waiting --lease--> leased --commit--> committed
///        ^                 |
///        +--expire, fail---+
///
/// Invariant: every task is in exactly one of the three states, and has at most one current token.
class Leases {
 public:
  struct Grant {
    std::uint32_t slot = 0;
    std::uint32_t attempt = 0;  // 1 for the first
    friend bool operator==(const Grant&, const Grant&) = default;
  };
  struct Counts {
    std::uint32_t waiting = 0, leased = 0, committed = 0;
    std::uint32_t failed = 0, expired = 0, diverged = 0;  // attempts
  };

  Leases(std::uint32_t tasks, LeasePolicy policy);

  /// The lowest waiting task that `worker` may run, now leased to it under `token`. A task that failed on this worker
  /// is its only once it has failed on all of `live` too.
  std::optional<Grant> lease(const std::string& worker, const std::set<std::string>& live, const std::string& token,
                             Time now);
  /// False when `token` is not current, and so its lease is lost.
  bool renew(const std::string& token, Time now);
  /// Only the current token changes anything. The result that a committed task already has is a duplicate, whoever
  /// sends it.
  CommitOutcome commit(std::uint32_t slot, const std::string& token, const std::string& digest);
  /// Puts the task back; a stale token changes nothing and gives false.
  bool fail(std::uint32_t slot, const std::string& token, FailureClass failure_class, const Error& error);
  /// Puts back the tasks whose leases have ended.
  void expire(Time now);
  /// Puts back what `worker` holds, counted nowhere: it said goodbye.
  void release(const std::string& worker);
  /// Ends all leases and waits: the job is over.
  void close();

  bool finished() const { return counts_.committed == tasks_.size(); }
  /// Why the job cannot finish; set once by fail() or expire().
  const std::optional<JobFailure>& verdict() const { return verdict_; }
  const Counts& counts() const { return counts_; }
  std::optional<Time> next_expiry() const;

 private:
  struct Task {
    enum class State { kWaiting, kLeased, kCommitted } state = State::kWaiting;
    std::uint32_t attempt = 0;
    std::string token, worker;  // of the latest attempt
    Time deadline{};
    std::set<std::string> failed_on;
    int failures = 0, losses = 0;
    std::string digest;  // committed
  };
  bool may_run(const Task& task, const std::string& worker, const std::set<std::string>& live) const;
  void put_back(std::uint32_t slot);

  LeasePolicy policy_;
  std::vector<Task> tasks_;
  std::set<std::uint32_t> waiting_;
  std::unordered_map<std::string, std::uint32_t> by_token_;  // current leases
  Counts counts_;
  std::optional<JobFailure> verdict_;
};

}  // namespace radfarm
