// The workers' half of Scheduler: leases, their renewal and end, and what happens when time passes.
#include <algorithm>
#include <utility>

#include "base/log.h"
#include "coordinator/scheduler.h"
#include "coordinator/tokens.h"

namespace radfarm {
namespace {

Time now() { return std::chrono::steady_clock::now(); }

void keep_earliest(std::optional<Time>& earliest, const std::optional<Time>& other) {
  if (other && (!earliest || *other < *earliest)) earliest = other;
}

}  // namespace

WorkerWelcome Scheduler::register_worker(const WorkerHello& hello) {
  const std::lock_guard lock(mutex_);
  const std::string id = random_token();
  workers_.add(id, hello, now());
  spdlog::info("worker {} '{}' registered: {} threads, pid {}, build {}, fingerprint {}", id.substr(0, 8), hello.name,
               hello.threads, hello.pid, hello.build, hello.fingerprint.substr(0, 12));
  deadline_changed_.notify_all();
  return {id, options_.leases.length};
}

void Scheduler::lease(LeaseWait wait) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return wait.answer(fail(Code::kUnavailable, "the coordinator is stopping"));
  const Time start = now();
  Waiter waiter{std::move(wait), start};
  waiter.deadline = start + waiter.wait.wait;
  if (serve(waiter, start)) return;
  waiters_.push_back(std::move(waiter));
  deadline_changed_.notify_all();
}

bool Scheduler::serve(Waiter& waiter, Time now) {
  const LeaseWait& wait = waiter.wait;
  if (wait.is_cancelled()) {
    wait.answer(fail(Code::kCancelled, "the worker hung up"));
    return true;
  }
  const Result<const Workers::Worker*> worker = workers_.touch(wait.worker_id, now);
  if (!worker) {
    wait.answer(tl::unexpected(worker.error()));
    return true;
  }
  if ((*worker)->quarantined) {
    wait.answer(fail(Code::kFailedPrecondition, "this worker is quarantined after repeated failures of its own"));
    return true;
  }
  std::vector<Lease> leases = take_tasks(wait.worker_id, **worker, wait.max_tasks, now);
  if (leases.empty() && now < waiter.deadline) return false;
  wait.answer(std::move(leases));
  return true;
}

std::vector<Lease> Scheduler::take_tasks(const std::string& worker_id, const Workers::Worker& worker,
                                         std::uint32_t max_tasks, Time now) {
  std::vector<Lease> leases;
  const std::string worker_class = worker.worker_class();
  const std::set<std::string> live = workers_.live(worker_class);
  for (const auto& entry : jobs_) {
    if (!entry->job.accepts(worker_class)) continue;
    // At most half of an equal share, so that no worker hoards the last tasks of a job.
    const JobProgress progress = entry->job.status().progress;
    const std::uint32_t waiting = progress.tasks_total - progress.tasks_committed - progress.tasks_leased;
    const auto share = std::max<std::uint32_t>(1, waiting / static_cast<std::uint32_t>(2 * live.size()));
    const std::size_t before = leases.size();
    while (leases.size() < max_tasks && leases.size() - before < share) {
      std::optional<Lease> lease = entry->job.lease(worker_id, live, random_token(), now);
      if (!lease) break;
      leases.push_back(std::move(*lease));
    }
    if (leases.size() == before) continue;
    entry->job.set_worker_class(worker_class);
    changed(*entry);
    if (leases.size() >= max_tasks) break;
  }
  if (!leases.empty()) deadline_changed_.notify_all();
  return leases;
}

void Scheduler::serve_waiters(Time now) {
  std::erase_if(waiters_, [&](Waiter& waiter) { return serve(waiter, now); });
}

Result<std::vector<std::string>> Scheduler::renew(const std::string& worker_id,
                                                  const std::vector<std::string>& tokens) {
  const std::lock_guard lock(mutex_);
  const Time time = now();
  RADFARM_TRY([[maybe_unused]] const Workers::Worker* const worker, workers_.touch(worker_id, time));
  std::vector<std::string> lost;
  for (const std::string& token : tokens) {
    const bool renewed =
        std::any_of(jobs_.begin(), jobs_.end(), [&](const auto& entry) { return entry->job.renew(token, time); });
    if (!renewed) lost.push_back(token);
  }
  return lost;
}

Result<CommitOutcome> Scheduler::commit(const CommitHeader& header, std::span<const std::byte> bytes) {
  {
    const std::lock_guard lock(mutex_);
    RADFARM_TRY([[maybe_unused]] const Workers::Worker* const known, workers_.touch(header.worker_id, now()));
    if (!find(header.job_id)) return CommitOutcome::kSuperseded;
  }
  // Results are kept as blobs, not in memory: rounds and extensions go on from them. The disk is not waited for under the mutex.
  RADFARM_TRY([[maybe_unused]] const BlobRef stored, blobs_.put(bytes));
  const std::lock_guard lock(mutex_);
  RADFARM_TRY(const Workers::Worker* const worker, workers_.touch(header.worker_id, now()));
  const Result<Entry*> entry = find(header.job_id);
  if (!entry) return CommitOutcome::kSuperseded;
  Job& job = (*entry)->job;
  const std::uint32_t diverged = job.status().progress.results_diverged;
  const CommitOutcome outcome = job.commit(header, worker->hello.name);
  if (job.status().progress.results_diverged != diverged) {
    spdlog::error("job {} task {}: worker '{}' computed other bits than the committed result", header.job_id,
                  header.slot, worker->hello.name);
  }
  if (outcome == CommitOutcome::kCommitted) {
    assemble_if_done(**entry);
    changed(**entry);
  }
  return outcome;
}

Status Scheduler::fail_task(const TaskFailure& failure) {
  const std::lock_guard lock(mutex_);
  const Time time = now();
  RADFARM_TRY(const Workers::Worker* const worker, workers_.touch(failure.worker_id, time));
  const Result<Entry*> entry = find(failure.job_id);
  if (!entry || !(*entry)->job.fail_task(failure)) return {};
  if (failure.failure_class != FailureClass::kPreempted) {
    spdlog::warn("job {} task {} failed on worker '{}': {}", failure.job_id, failure.slot, worker->hello.name,
                 failure.error.message);
  }
  if (failure.failure_class == FailureClass::kWorker && workers_.count_own_failure(failure.worker_id)) {
    spdlog::error("worker '{}' is quarantined", worker->hello.name);
  }
  fail_if_broken(**entry);
  changed(**entry);
  serve_waiters(time);
  return {};
}

Status Scheduler::unregister_worker(const std::string& worker_id) {
  const std::lock_guard lock(mutex_);
  RADFARM_TRY(const Workers::Worker* const worker, workers_.touch(worker_id, now()));
  spdlog::info("worker '{}' left", worker->hello.name);
  workers_.remove(worker_id);
  for (const auto& entry : jobs_) {
    if (entry->job.state() != JobState::kRendering) continue;
    entry->job.release(worker_id);
    changed(*entry);
  }
  serve_waiters(now());
  return {};
}

void Scheduler::expire(Time now) {
  for (const std::string& id : workers_.forget_silent(now)) spdlog::warn("worker {} fell silent", id.substr(0, 8));
  for (const auto& entry : jobs_) {
    if (entry->job.state() != JobState::kRendering) continue;
    const std::uint32_t before = entry->job.status().progress.attempts_expired;
    entry->job.expire(now);
    const std::uint32_t expired = entry->job.status().progress.attempts_expired - before;
    if (expired == 0) continue;
    spdlog::warn("job {}: {} leases expired; their tasks wait again", entry->job.id(), expired);
    fail_if_broken(*entry);
    changed(*entry);
  }
  serve_waiters(now);
}

std::optional<Time> Scheduler::next_deadline() const {
  std::optional<Time> next = workers_.next_silence();
  for (const auto& entry : jobs_) keep_earliest(next, entry->job.next_expiry());
  for (const Waiter& waiter : waiters_) keep_earliest(next, waiter.deadline);
  return next;
}

void Scheduler::run_timer() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (const std::optional<Time> next = next_deadline()) {
      deadline_changed_.wait_until(lock, *next);
    } else {
      deadline_changed_.wait(lock);
    }
    if (!stopping_) expire(now());
  }
}

}  // namespace radfarm
