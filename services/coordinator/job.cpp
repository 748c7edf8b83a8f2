#include "coordinator/job.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace radfarm {

Job::Job(std::string id, JobSpec spec, std::int64_t created_unix_seconds, LeasePolicy policy, Target target)
    : id_(std::move(id)),
      spec_(std::move(spec)),
      created_unix_seconds_(created_unix_seconds),
      policy_(policy),
      leases_(0, policy),
      target_(target) {}

void Job::enter(JobState state) {
  state_ = state;
  phase_ = {};
  ++revision_;
  if (is_terminal(state)) {
    leases_.close();
    if (state != JobState::kSucceeded) results_.clear();
    before_.clear();
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

void Job::lay_out(const Round& round, std::vector<Task> tasks) {
  round_ = round;
  tasks_ = std::move(tasks);
  leases_ = Leases(static_cast<std::uint32_t>(tasks_.size()), policy_);
  results_.assign(tasks_.size(), {});
  light_cpu_seconds_ = audit_cpu_seconds_ = 0;
}

void Job::start_rendering(PreparedJob prepared) {
  RADFARM_CHECK(state_ == JobState::kPreparing);
  inputs_ = std::move(prepared.inputs);
  estimates_ = std::move(prepared.estimates);
  before_.clear();
  lay_out(prepared.round, std::move(prepared.tasks));
  enter(JobState::kRendering);
}

void Job::record(RoundFigures figures) {
  RADFARM_CHECK(state_ == JobState::kAssembling);
  if (!rounds_.empty() && rounds_.back().round.number == figures.round.number) rounds_.pop_back();
  rounds_.push_back(std::move(figures));
}

void Job::go_on(const Round& round, std::vector<Task> tasks) {
  RADFARM_CHECK(state_ == JobState::kAssembling && rounds_left_ > 0);
  --rounds_left_;
  before_ = std::move(results_);
  for (std::size_t slot = 0; slot < before_.size(); ++slot) {
    // Audits never go on: each has fresh pixels.
    if (tasks_[slot].kind == Task::Kind::kAudit) before_[slot] = {};
  }
  kind_ = RoundFigures::Kind::kMoreSamples;
  lay_out(round, std::move(tasks));
  before_.resize(tasks_.size());
  enter(JobState::kRendering);
}

void Job::prepare_anew(const Round& round, const Effort& effort) {
  RADFARM_CHECK(state_ == JobState::kAssembling && rounds_left_ > 0);
  --rounds_left_;
  effort_ = effort;
  kind_ = RoundFigures::Kind::kNewLight;
  before_.clear();
  lay_out(round, {});
  enter(JobState::kPreparing);
}

void Job::start_assembling() {
  RADFARM_CHECK(state_ == JobState::kRendering && all_committed());
  enter(JobState::kAssembling);
}

void Job::succeed(std::vector<Artifact> artifacts, bool target_missed) {
  RADFARM_CHECK(state_ == JobState::kAssembling);
  artifacts_ = std::move(artifacts);
  target_missed_ = target_missed;
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

Result<bool> Job::extend(const Target& target) {
  if (target == target_ && (state_ == JobState::kSucceeded ? !target_missed_ : !is_terminal(state_))) return false;
  if (state_ != JobState::kSucceeded) {
    return radfarm::fail(Code::kFailedPrecondition,
                         "job " + id_ + " is " + to_string(state_) + "; only one that has SUCCEEDED can be extended");
  }
  target_ = target;
  target_missed_ = false;
  rounds_left_ = kMostRounds;
  enter(JobState::kAssembling);
  return true;
}

bool Job::accepts(const std::string& worker_class) const {
  if (state_ != JobState::kRendering) return false;
  const Leases::Counts& counts = leases_.counts();
  return worker_class_ == worker_class || (counts.leased == 0 && counts.committed == 0 && before_.empty());
}

std::optional<Lease> Job::lease(const std::string& worker, const std::set<std::string>& live, const std::string& token,
                                Time now) {
  if (state_ != JobState::kRendering) return std::nullopt;
  const std::optional<Leases::Grant> grant = leases_.lease(worker, live, token, now);
  if (!grant) return std::nullopt;
  ++revision_;
  const std::string before = before_.empty() ? "" : before_[grant->slot].digest;
  return Lease{id_, grant->slot, tasks_[grant->slot], inputs_, grant->attempt, token, round_, before};
}

CommitOutcome Job::commit(const CommitHeader& header, const std::string& worker_name) {
  if (state_ != JobState::kRendering || header.round != round_.number) return CommitOutcome::kSuperseded;
  const CommitOutcome outcome = leases_.commit(header.slot, header.token, header.result.digest);
  ++revision_;
  if (outcome != CommitOutcome::kCommitted) return outcome;
  results_[header.slot] = header.result;
  (tasks_[header.slot].kind == Task::Kind::kAudit ? audit_cpu_seconds_ : light_cpu_seconds_) += header.cpu_seconds;
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
  double cpu_seconds = 0;
  for (const auto& [name, worker] : workers_) cpu_seconds += worker.cpu_seconds;
  const std::uint32_t round = total > 0 || round_.number > 0 ? round_.number + 1 : 0;
  return {id_,
          spec_.display_name,
          state_,
          revision_,
          created_unix_seconds_,
          {total, counts.committed, counts.leased, counts.failed, counts.expired, counts.diverged, "", phase_, round},
          failure_.value_or(JobFailure{}),
          artifacts_,
          target_missed_,
          estimates_,
          cpu_seconds};
}

std::vector<FarmFacts::Worker> Job::worker_facts() const {
  std::vector<FarmFacts::Worker> facts;
  for (const auto& [name, worker] : workers_) facts.push_back(worker);
  return facts;
}

}  // namespace radfarm
