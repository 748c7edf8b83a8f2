#include "coordinator/leases.h"

#include <algorithm>

#include "base/check.h"

namespace radfarm {

Leases::Leases(std::uint32_t tasks, LeasePolicy policy) : policy_(policy), tasks_(tasks) {
  for (std::uint32_t slot = 0; slot < tasks; ++slot) waiting_.insert(waiting_.end(), slot);
  counts_.waiting = tasks;
}

bool Leases::may_run(const Task& task, const std::string& worker, const std::set<std::string>& live) const {
  if (!task.failed_on.contains(worker)) return true;
  return std::includes(task.failed_on.begin(), task.failed_on.end(), live.begin(), live.end());
}

std::optional<Leases::Grant> Leases::lease(const std::string& worker, const std::set<std::string>& live,
                                           const std::string& token, Time now) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](std::uint32_t slot) { return may_run(tasks_[slot], worker, live); });
  if (found == waiting_.end()) return std::nullopt;
  const std::uint32_t slot = *found;
  RADFARM_CHECK(by_token_.emplace(token, slot).second);
  waiting_.erase(found);
  Task& task = tasks_[slot];
  task.state = Task::State::kLeased;
  ++task.attempt;
  task.token = token;
  task.worker = worker;
  task.deadline = now + policy_.length;
  --counts_.waiting;
  ++counts_.leased;
  return Grant{slot, task.attempt};
}

bool Leases::renew(const std::string& token, Time now) {
  const auto found = by_token_.find(token);
  if (found == by_token_.end()) return false;
  tasks_[found->second].deadline = now + policy_.length;
  return true;
}

CommitOutcome Leases::commit(std::uint32_t slot, const std::string& token, const std::string& digest) {
  if (slot >= tasks_.size()) return CommitOutcome::kSuperseded;
  Task& task = tasks_[slot];
  if (task.state == Task::State::kCommitted) {
    if (task.digest == digest) return CommitOutcome::kDuplicate;
    ++counts_.diverged;
    return CommitOutcome::kSuperseded;
  }
  if (task.state != Task::State::kLeased || task.token != token) return CommitOutcome::kSuperseded;
  by_token_.erase(token);
  task.state = Task::State::kCommitted;
  task.digest = digest;
  --counts_.leased;
  ++counts_.committed;
  return CommitOutcome::kCommitted;
}

bool Leases::fail(std::uint32_t slot, const std::string& token, FailureClass failure_class, const Error& error) {
  const auto found = by_token_.find(token);
  if (found == by_token_.end() || found->second != slot) return false;
  Task& task = tasks_[slot];
  put_back(slot);
  if (failure_class == FailureClass::kPreempted) return true;
  ++counts_.failed;
  task.failed_on.insert(task.worker);
  const bool fatal = failure_class == FailureClass::kData ||
                     (failure_class == FailureClass::kTask && ++task.failures >= policy_.task_failures);
  if (fatal && !verdict_) {
    verdict_ = JobFailure{JobFailure::Reason::kTaskFailed,
                          {error.code, "task " + std::to_string(slot) + ": " + error.message}};
  }
  return true;
}

void Leases::expire(Time now) {
  for (std::uint32_t slot = 0; slot < tasks_.size(); ++slot) {
    Task& task = tasks_[slot];
    if (task.state != Task::State::kLeased || now < task.deadline) continue;
    put_back(slot);
    ++counts_.expired;
    if (++task.losses < policy_.losses || verdict_) continue;
    verdict_ = JobFailure{JobFailure::Reason::kTaskLost,
                          {Code::kAborted, "task " + std::to_string(slot) + ": " + std::to_string(task.losses) +
                                               " workers fell silent while they held it"}};
  }
}

void Leases::release(const std::string& worker) {
  for (std::uint32_t slot = 0; slot < tasks_.size(); ++slot) {
    if (tasks_[slot].state == Task::State::kLeased && tasks_[slot].worker == worker) put_back(slot);
  }
}

void Leases::close() {
  for (std::uint32_t slot = 0; slot < tasks_.size(); ++slot) {
    if (tasks_[slot].state == Task::State::kLeased) put_back(slot);
  }
  waiting_.clear();
}

std::optional<Time> Leases::next_expiry() const {
  std::optional<Time> next;
  for (const auto& [token, slot] : by_token_) {
    if (!next || tasks_[slot].deadline < *next) next = tasks_[slot].deadline;
  }
  return next;
}

void Leases::put_back(std::uint32_t slot) {
  by_token_.erase(tasks_[slot].token);
  tasks_[slot].state = Task::State::kWaiting;
  waiting_.insert(slot);
  --counts_.leased;
  ++counts_.waiting;
}

}  // namespace radfarm
