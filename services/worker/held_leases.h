#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rpc/messages.h"

namespace radfarm {

/// What a worker process holds: leases that wait for a thread and leases that run. Plain state; the caller locks.
class HeldLeases {
 public:
  void add(std::vector<Lease> leases);
  /// The next one to run; it counts as running until done().
  std::optional<Lease> start();
  void done(const std::string& token) { running_.erase(token); }
  /// Forgets the waiting ones among the lost and says of the running ones that nobody wants them any more.
  void lose(const std::vector<std::string>& tokens);
  /// False when the lease was lost meanwhile: its result need not be sent.
  bool is_current(const std::string& token) const { return running_.contains(token) && !lost_.contains(token); }
  /// The leases that wait, handed over: they go back to the coordinator.
  std::vector<Lease> drop_waiting();

  std::vector<std::string> tokens() const;  // waiting and running, without the lost
  std::size_t size() const { return waiting_.size() + running_.size(); }
  bool has_waiting() const { return !waiting_.empty(); }

 private:
  std::deque<Lease> waiting_;
  std::set<std::string> running_;  // tokens
  std::set<std::string> lost_;     // tokens, a subset of those that run
};

}  // namespace radfarm
