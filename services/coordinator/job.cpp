#include "coordinator/job.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace radfarm {

Job::Job(std::string id, JobSpec spec, std::int64_t created_unix_seconds, LeasePolicy policy)
    : id_(std::move(id)),
      spec_(std::move(spec)),
      created_unix_seconds_(created_unix_seconds),
      policy_(policy),
      leases_(0, policy) {}

void Job::enter(JobState state) {
  state_ = state;
  phase_ = {};
  ++revision_;
  if (is_terminal(state)) {
    leases_.close();
    results_.clear();
  }
}

void Job::start_preparing() {
  RADFARM_CHECK(state_ == JobState::kQueued);
  enter(JobState::kPreparing);
}

bool Job::prepare_progress(JobPhase phase) {
  if (state_ != JobState::kPreparing) return false;
  phase_ = std::move(phase);
  ++revision_;
  return true;
}

void Job::start_rendering(TaskInputs inputs, std::vector<Task> tasks) {
  RADFARM_CHECK(state_ == JobState::kPreparing);
  inputs_ = std::move(inputs);
  tasks_ = std::move(tasks);
  leases_ = Leases(static_cast<std::uint32_t>(tasks_.size()), policy_);
  results_.resize(tasks_.size());
  enter(JobState::kRendering);
}

void Job::start_assembling() {
  RADFARM_CHECK(state_ == JobState::kRendering && all_committed());
  enter(JobState::kAssembling);
}

void Job::succeed(std::vector<Artifact> artifacts) {
  RADFARM_CHECK(state_ == JobState::kAssembling);
  artifacts_ = std::move(artifacts);
  enter(JobState::kSucceeded);
}

void Job::fail(JobFailure failure) {
  RADFARM_CHECK(!is_terminal(state_));
  failure_ = std::move(failure);
  enter(JobState::kFailed);
}

void Job::confirm_cancel() {
  RADFARM_CHECK(state_ == JobState::kCancelling);
  enter(JobState::kCancelled);
}

Status Job::cancel() {
  if (state_ == JobState::kCancelling || state_ == JobState::kCancelled) return {};
  if (is_terminal(state_)) return radfarm::fail(Code::kFailedPrecondition, "job " + id_ + " is " + to_string(state_));
  enter(state_ == JobState::kPreparing ? JobState::kCancelling : JobState::kCancelled);
  return {};
}

bool Job::accepts(const std::string& worker_class) const {
  if (state_ != JobState::kRendering) return false;
  const Leases::Counts& counts = leases_.counts();
  return worker_class_ == worker_class || (counts.leased == 0 && counts.committed == 0);
}

std::optional<Lease> Job::lease(const std::string& worker, const std::set<std::string>& live, const std::string& token,
                                Time now) {
  if (state_ != JobState::kRendering) return std::nullopt;
  const std::optional<Leases::Grant> grant = leases_.lease(worker, live, token, now);
  if (!grant) return std::nullopt;
  ++revision_;
  return Lease{id_, grant->slot, tasks_[grant->slot], inputs_, grant->attempt, token};
}

CommitOutcome Job::commit(const CommitHeader& header, const std::string& worker_name, std::vector<std::byte> bytes) {
  if (state_ != JobState::kRendering) return CommitOutcome::kSuperseded;
  const CommitOutcome outcome = leases_.commit(header.slot, header.token, header.result.digest);
  ++revision_;
  if (outcome != CommitOutcome::kCommitted) return outcome;
  results_[header.slot] = std::move(bytes);
  FarmFacts::Worker& worker = workers_[worker_name];
  worker.name = worker_name;
  ++worker.tasks;
  worker.cpu_seconds += header.cpu_seconds;
  worker.peak_memory_bytes = std::max(worker.peak_memory_bytes, static_cast<long long>(header.peak_memory_bytes));
  return outcome;
}

bool Job::fail_task(const TaskFailure& failure) {
  ++revision_;
  return leases_.fail(failure.slot, failure.token, failure.failure_class, failure.error);
}

void Job::expire(Time now) {
  const std::uint32_t before = leases_.counts().expired;
  leases_.expire(now);
  if (leases_.counts().expired != before) ++revision_;
}

void Job::release(const std::string& worker) {
  leases_.release(worker);
  ++revision_;
}

JobStatus Job::status() const {
  const Leases::Counts& counts = leases_.counts();
  const auto total = static_cast<std::uint32_t>(tasks_.size());
  return {id_,
          spec_.display_name,
          state_,
          revision_,
          created_unix_seconds_,
          {total, counts.committed, counts.leased, counts.failed, counts.expired, counts.diverged, "", phase_},
          failure_.value_or(JobFailure{}),
          artifacts_};
}

std::vector<FarmFacts::Worker> Job::worker_facts() const {
  std::vector<FarmFacts::Worker> facts;
  for (const auto& [name, worker] : workers_) facts.push_back(worker);
  return facts;
}

}  // namespace radfarm
