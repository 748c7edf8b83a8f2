#include "worker/worker_loop.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "base/stopwatch.h"
#include "pipeline/fingerprint.h"
#include "rpc/channel.h"
#include "rpc/limits.h"
#include "rpc/retry.h"

namespace radfarm {
namespace {

constexpr std::chrono::seconds kLeaseWait{20};

using Clock = std::chrono::steady_clock;

rpc::RetryPolicy commit_policy(std::chrono::milliseconds patience) {
  rpc::RetryPolicy policy;
  policy.give_up_after = patience;
  return policy;
}

/// A blob that is gone or damaged is the job's fault; anything else that keeps us from its data is ours.
FailureClass opening_failure(const Error& error) {
  const bool data =
      error.code == Code::kNotFound || error.code == Code::kDataLoss || error.code == Code::kInvalidArgument;
  return data ? FailureClass::kData : FailureClass::kWorker;
}

}  // namespace

WorkerLoop::WorkerLoop(WorkerOptions options, const BlobStore& cache)
    : options_(std::move(options)),
      blobs_(rpc::open_channel(options_.coordinator)),
      coordinator_(rpc::open_channel(options_.coordinator)),
      prepared_(blobs_, cache),
      last_answer_(Clock::now()) {}

Status WorkerLoop::run() {
  std::vector<std::thread> runners;
  for (std::uint32_t i = 0; i < options_.threads; ++i) runners.emplace_back([this] { run_tasks(); });
  std::thread renewer([this] { renew_until_stopped(); });
  const Status ended = lease_until_stopped();

  // No new leases from here on. What waits goes back, what runs is finished and handed in, then we leave.
  return_waiting();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = draining_ = true;
  }
  changed_.notify_all();
  for (std::thread& runner : runners) runner.join();
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  changed_.notify_all();
  renewer.join();
  if (ended && !worker_id().empty()) (void)coordinator_.unregister_worker(worker_id());
  return ended;
}

void WorkerLoop::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  coordinator_.stop_waiting();
}

Status WorkerLoop::lease_until_stopped() {
  for (int failures = 0;;) {
    Status status = lease_once();
    std::unique_lock lock(mutex_);
    if (stopping_) return {};
    if (status) {
      failures = 0;
      continue;
    }
    const Code code = status.error().code;
    const bool temporary = code == Code::kUnavailable || code == Code::kDeadlineExceeded || code == Code::kCancelled;
    if (code == Code::kNotFound) {
      worker_id_.clear();  // the coordinator restarted: whatever we hold is worth nothing to it
      held_.lose(held_.tokens());
      continue;
    }
    if (!temporary) return status;
    if (Clock::now() - last_answer_ > options_.patience) {
      return annotate(status.error(), options_.coordinator + " has been silent for " +
                                          std::to_string(options_.patience.count() / 1000) + " s");
    }
    const auto wait = rpc::backoff({}, ++failures, static_cast<std::uint64_t>(::getpid()));
    lock.unlock();
    if (!pause(wait)) return {};
  }
}

Status WorkerLoop::lease_once() {
  if (worker_id().empty()) {
    const Status registered = register_here();
    note_answer(registered);
    return registered;
  }
  std::uint32_t wanted = 0;
  {
    // One task on each thread and one more for each that waits for its turn here and not on the network.
    std::unique_lock lock(mutex_);
    const std::size_t capacity = 2 * std::size_t{options_.threads};
    changed_.wait(lock, [&] { return stopping_ || held_.size() < capacity; });
    if (stopping_) return {};
    wanted = static_cast<std::uint32_t>(capacity - held_.size());
  }
  Result<std::vector<Lease>> leases = coordinator_.lease(worker_id(), wanted, kLeaseWait);
  note_answer(leases ? Status() : tl::unexpected(leases.error()));
  if (!leases) return tl::unexpected(leases.error());
  {
    const std::lock_guard lock(mutex_);
    held_.add(std::move(*leases));
  }
  changed_.notify_all();
  return {};
}

Status WorkerLoop::register_here() {
  const WorkerHello hello{options_.name, build_id(), numeric_fingerprint(), options_.threads,
                          static_cast<std::uint32_t>(::getpid())};
  RADFARM_TRY(const WorkerWelcome welcome, coordinator_.register_worker(hello));
  const std::lock_guard lock(mutex_);
  worker_id_ = welcome.worker_id;
  lease_length_ = welcome.lease_length;
  spdlog::info("registered at {} as '{}'", options_.coordinator, options_.name);
  return {};
}

void WorkerLoop::renew_until_stopped() {
  std::unique_lock lock(mutex_);
  while (!finished_) {
    const auto wait = lease_length_.count() > 0 ? lease_length_ / 4 : std::chrono::milliseconds(1000);
    changed_.wait_until(lock, Clock::now() + wait, [&] { return finished_; });
    const std::vector<std::string> tokens = held_.tokens();
    if (finished_ || worker_id_.empty() || tokens.empty()) continue;
    const std::string id = worker_id_;
    lock.unlock();
    const Result<std::vector<std::string>> lost = coordinator_.renew(id, tokens);
    note_answer(lost ? Status() : tl::unexpected(lost.error()));
    lock.lock();
    if (lost) held_.lose(*lost);
  }
}

void WorkerLoop::run_tasks() {
  for (;;) {
    std::optional<Lease> lease;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return draining_ || held_.has_waiting(); });
      lease = held_.start();
      if (!lease) return;
    }
    run_one(*lease);
    {
      const std::lock_guard lock(mutex_);
      held_.done(lease->token);
    }
    changed_.notify_all();
  }
}

void WorkerLoop::run_one(const Lease& lease) {
  const Result<std::shared_ptr<const Prepared>> prepared = prepared_.get(lease.inputs);
  if (!prepared) return report_failure(lease, opening_failure(prepared.error()), prepared.error());
  std::vector<std::byte> before;
  if (!lease.before.empty()) {
    Result<std::vector<std::byte>> fetched = blobs_.download(lease.before, limits::kResultBytes);
    if (!fetched) return report_failure(lease, opening_failure(fetched.error()), fetched.error());
    before = std::move(*fetched);
  }
  const double start = thread_cpu_seconds();
  const Result<std::vector<std::byte>> result = run_task(**prepared, lease.task, {lease.round, before});
  if (!result) return report_failure(lease, FailureClass::kTask, result.error());
  hand_in(lease, *result, thread_cpu_seconds() - start);
}

void WorkerLoop::hand_in(const Lease& lease, std::span<const std::byte> result, double cpu_seconds) {
  const CommitHeader header{worker_id(),           lease.job_id, lease.slot,         lease.token,
                            rpc::blob_ref(result), cpu_seconds,  peak_memory_bytes(), lease.round.number};
  CommitOutcome outcome = CommitOutcome::kSuperseded;
  const Status handed = rpc::with_retries(
      commit_policy(options_.patience), [this](auto wait) { return pause(wait); },
      [&]() -> Status {
        {
          const std::lock_guard lock(mutex_);
          if (!held_.is_current(lease.token)) return {};
        }
        const Result<CommitOutcome> answer = coordinator_.commit(header, result);
        note_answer(answer ? Status() : tl::unexpected(answer.error()));
        if (!answer) return tl::unexpected(answer.error());
        outcome = *answer;
        return {};
      });
  if (!handed) {
    spdlog::warn("task {} of job {}: cannot hand in: {}", lease.slot, lease.job_id, handed.error().message);
  } else if (outcome != CommitOutcome::kCommitted) {
    spdlog::info("task {} of job {}: result was not needed", lease.slot, lease.job_id);
  }
}

void WorkerLoop::report_failure(const Lease& lease, FailureClass failure_class, const Error& error) {
  if (failure_class != FailureClass::kPreempted) {
    spdlog::warn("task {} of job {} failed: {}", lease.slot, lease.job_id, error.message);
  }
  const TaskFailure failure{worker_id(), lease.job_id, lease.slot, lease.token, failure_class, error};
  const Status reported = rpc::with_retries(
      {}, [this](auto wait) { return pause(wait); }, [&] { return coordinator_.fail_task(failure); });
  if (!reported) spdlog::warn("cannot report a failed task: {}", reported.error().message);
}

void WorkerLoop::return_waiting() {
  std::vector<Lease> waiting;
  {
    const std::lock_guard lock(mutex_);
    waiting = held_.drop_waiting();
  }
  for (const Lease& lease : waiting) {
    report_failure(lease, FailureClass::kPreempted, {Code::kCancelled, "the worker is stopping"});
  }
}

void WorkerLoop::note_answer(const Status& status) {
  const bool silent =
      !status && (status.error().code == Code::kUnavailable || status.error().code == Code::kDeadlineExceeded ||
                  status.error().code == Code::kCancelled);
  if (silent) return;
  const std::lock_guard lock(mutex_);
  last_answer_ = Clock::now();
}

/// Waits between attempts; false when this worker is stopping, so that attempts end after one more answer.
bool WorkerLoop::pause(std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, Clock::now() + wait, [&] { return stopping_; });
  return !stopping_;
}

std::string WorkerLoop::worker_id() {
  const std::lock_guard lock(mutex_);
  return worker_id_;
}

}  // namespace radfarm
