#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "coordinator/leases.h"
#include "rpc/messages.h"

namespace radfarm {

/// The workers that have registered. Plain state, like Leases: time comes in.
class Workers {
 public:
  struct Policy {
    std::chrono::milliseconds silence{120000};  // after which a worker is forgotten
    int own_failures = 3;                       // WORKER failures that quarantine it
  };
  struct Worker {
    WorkerHello hello;
    Time last_seen{};
    int own_failures = 0;
    bool quarantined = false;
    /// Workers of equal class compute equal bits.
    std::string worker_class() const { return hello.build + "/" + hello.fingerprint; }
  };

  explicit Workers(Policy policy) : policy_(policy) {}

  void add(const std::string& id, WorkerHello hello, Time now);
  /// The worker, seen now. NOT_FOUND when it never registered or was forgotten.
  Result<const Worker*> touch(const std::string& id, Time now);
  /// Counts a failure of the worker itself; true when that quarantined it.
  bool count_own_failure(const std::string& id);
  void remove(const std::string& id) { workers_.erase(id); }
  /// Forgets those that have been silent; their ids.
  std::set<std::string> forget_silent(Time now);

  /// Workers of one class that may take work.
  std::set<std::string> live(const std::string& worker_class) const;
  std::size_t count() const { return workers_.size(); }
  int threads() const;  // of all
  std::optional<Time> next_silence() const;

 private:
  Policy policy_;
  std::map<std::string, Worker> workers_;
};

}  // namespace radfarm
