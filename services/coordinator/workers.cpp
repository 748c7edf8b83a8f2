#include "coordinator/workers.h"

#include <algorithm>
#include <utility>

namespace radfarm {

void Workers::add(const std::string& id, WorkerHello hello, Time now) {
  workers_[id] = Worker{std::move(hello), now, 0, false};
}

Result<const Workers::Worker*> Workers::touch(const std::string& id, Time now) {
  const auto found = workers_.find(id);
  if (found == workers_.end()) {
    return fail(Code::kNotFound, "worker " + id.substr(0, 100) + " is not registered here; register again");
  }
  found->second.last_seen = now;
  return &found->second;
}

bool Workers::count_own_failure(const std::string& id) {
  const auto found = workers_.find(id);
  if (found == workers_.end() || found->second.quarantined) return false;
  found->second.quarantined = ++found->second.own_failures >= policy_.own_failures;
  return found->second.quarantined;
}

std::set<std::string> Workers::forget_silent(Time now) {
  std::set<std::string> forgotten;
  for (const auto& [id, worker] : workers_) {
    if (now >= worker.last_seen + policy_.silence) forgotten.insert(id);
  }
  for (const std::string& id : forgotten) workers_.erase(id);
  return forgotten;
}

std::set<std::string> Workers::live(const std::string& worker_class) const {
  std::set<std::string> ids;
  for (const auto& [id, worker] : workers_) {
    if (!worker.quarantined && worker.worker_class() == worker_class) ids.insert(id);
  }
  return ids;
}

std::optional<Time> Workers::next_silence() const {
  std::optional<Time> next;
  for (const auto& [id, worker] : workers_) {
    const Time silence = worker.last_seen + policy_.silence;
    if (!next || silence < *next) next = silence;
  }
  return next;
}

int Workers::threads() const {
  int threads = 0;
  for (const auto& [id, worker] : workers_) threads += static_cast<int>(worker.hello.threads);
  return threads;
}

}  // namespace radfarm
