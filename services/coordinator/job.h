#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/leases.h"
#include "coordinator/prepared_job.h"
#include "pipeline/pipeline.h"
#include "rpc/messages.h"

namespace radfarm {

/// One render from request to artifacts, in one round or, for a target, several. A plain state machine: no clock, thread or
/// socket.
///
///                    +---------new light----------+<-----extend-----+
///                    v                            |                 |
///     QUEUED -> PREPARING -> RENDERING -----> ASSEMBLING -----> SUCCEEDED
///        |          |          |   ^--more samples--|
///        |          |          |                    |
///        |          +--cancel--|--------------------|--> CANCELLING --stopped--> CANCELLED
///        +-------cancel--------+--------------------+--------------------------> CANCELLED
///     any of the first four: FAILED
///
/// Invariants: a terminal job has no live lease; results_[i] is the stored result of tasks_[i] in this round or empty,
/// before_[i] that of the round before, which it goes on from. Results stay stored as long as the job may be extended.
class Job {
 public:
  Job(std::string id, JobSpec spec, std::int64_t created_unix_seconds, LeasePolicy policy, Target target = {});

  // What the scheduler reports. Requires: the state on the left of the arrow.
  void start_preparing();                                            // QUEUED -> PREPARING
  /// Keeps what the preparation says of itself; of a job in another state it is nothing new. True when it was kept.
  bool prepare_progress(JobPhase phase);
  void start_rendering(PreparedJob prepared);                        // PREPARING -> RENDERING, or a job without tasks
  void start_assembling();                                           // RENDERING, all committed -> ASSEMBLING
  /// What a round came to; replaces what is known of the same one.
  void record(RoundFigures figures);
  void go_on(const Round& round, std::vector<Task> tasks);           // ASSEMBLING -> RENDERING, from the results that there are
  void prepare_anew(const Round& round, const Effort& effort);       // ASSEMBLING -> PREPARING; results are dropped
  void succeed(std::vector<Artifact> artifacts, bool target_missed); // ASSEMBLING -> SUCCEEDED
  void fail(JobFailure failure);                                     // not terminal -> FAILED
  void confirm_cancel();                                             // CANCELLING -> CANCELLED

  /// FAILED_PRECONDITION when the job has succeeded or failed.
  Status cancel();
  /// SUCCEEDED -> ASSEMBLING, with new rounds. FAILED_PRECONDITION in any other state; true when that changed anything.
  Result<bool> extend(const Target& target);

  /// One task for `worker`, or nothing. `live`: the workers that could run this job now.
  std::optional<Lease> lease(const std::string& worker, const std::set<std::string>& live, const std::string& token,
                             Time now);
  bool renew(const std::string& token, Time now) { return leases_.renew(token, now); }
  /// Of a stored result. Of another round than this, it is superseded.
  CommitOutcome commit(const CommitHeader& header, const std::string& worker_name);
  bool fail_task(const TaskFailure& failure);
  void expire(Time now);
  void release(const std::string& worker);

  bool all_committed() const { return leases_.finished(); }
  std::optional<JobFailure> verdict() const { return leases_.verdict(); }
  std::optional<Time> next_expiry() const { return leases_.next_expiry(); }
  /// Workers of one build and fingerprint run a job. Any may, as long as no task is leased, committed or goes on from another's
  /// sums.
  bool accepts(const std::string& worker_class) const;

  JobState state() const { return state_; }
  const std::string& id() const { return id_; }
  const JobSpec& spec() const { return spec_; }
  const TaskInputs& inputs() const { return inputs_; }
  JobStatus status() const;
  void set_worker_class(const std::string& worker_class) { worker_class_ = worker_class; }
  std::vector<FarmFacts::Worker> worker_facts() const;
  const Target& target() const { return target_; }
  const Effort& effort() const { return effort_; }
  const Round& round() const { return round_; }
  RoundFigures::Kind round_kind() const { return kind_; }
  const std::vector<RoundFigures>& rounds() const { return rounds_; }
  /// That the target still allows after the one that is assembled.
  std::uint32_t rounds_left() const { return rounds_left_; }
  const std::vector<BlobRef>& results() const { return results_; }
  /// CPU seconds of this round's committed tasks.
  double light_cpu_seconds() const { return light_cpu_seconds_; }
  double audit_cpu_seconds() const { return audit_cpu_seconds_; }

 private:
  void enter(JobState state);
  /// Tasks of a round, none of which has run.
  void lay_out(const Round& round, std::vector<Task> tasks);

  std::string id_;
  JobSpec spec_;
  std::int64_t created_unix_seconds_;
  LeasePolicy policy_;
  JobState state_ = JobState::kQueued;
  std::uint64_t revision_ = 1;
  JobPhase phase_;  // while PREPARING
  TaskInputs inputs_;
  std::vector<Task> tasks_;
  Leases leases_;
  std::vector<BlobRef> results_, before_;
  Target target_;
  Effort effort_;
  Round round_;
  RoundFigures::Kind kind_ = RoundFigures::Kind::kFirst;
  std::vector<RoundFigures> rounds_;
  std::uint32_t rounds_left_ = kMostRounds - 1;
  double light_cpu_seconds_ = 0, audit_cpu_seconds_ = 0;
  std::vector<CostEstimate> estimates_;
  bool target_missed_ = false;
  std::map<std::string, FarmFacts::Worker> workers_;  // by name
  std::string worker_class_;
  std::optional<JobFailure> failure_;
  std::vector<Artifact> artifacts_;
};

}  // namespace radfarm
