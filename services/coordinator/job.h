#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/leases.h"
#include "pipeline/pipeline.h"
#include "rpc/messages.h"

namespace radfarm {

/// One render from request to artifacts. A plain state machine: no clock, thread or socket.
///
///     QUEUED -> PREPARING -> RENDERING -> ASSEMBLING -> SUCCEEDED
///        |          |            |            |
///        |          +--cancel----|------------|--> CANCELLING --stopped--> CANCELLED
///        +-------cancel----------+------------+--------------------------> CANCELLED
///     any of the first four: FAILED
///
/// Invariants: a terminal job has no live lease; results_[i] is the committed bytes of tasks_[i] or empty.
class Job {
 public:
  Job(std::string id, JobSpec spec, std::int64_t created_unix_seconds, LeasePolicy policy);

  // What the scheduler reports. Requires: the state on the left of the arrow.
  void start_preparing();                                            // QUEUED -> PREPARING
  /// Keeps what the preparation says of itself; of a job in another state it is nothing new. True when it was kept.
  bool prepare_progress(JobPhase phase);
  void start_rendering(TaskInputs inputs, std::vector<Task> tasks);  // PREPARING -> RENDERING, or a job without tasks
  void start_assembling();                                           // RENDERING, all committed -> ASSEMBLING
  void succeed(std::vector<Artifact> artifacts);                     // ASSEMBLING -> SUCCEEDED
  void fail(JobFailure failure);                                     // not terminal -> FAILED
  void confirm_cancel();                                             // CANCELLING -> CANCELLED

  /// FAILED_PRECONDITION when the job has succeeded or failed.
  Status cancel();

  /// One task for `worker`, or nothing. `live`: the workers that could run this job now.
  std::optional<Lease> lease(const std::string& worker, const std::set<std::string>& live, const std::string& token,
                             Time now);
  bool renew(const std::string& token, Time now) { return leases_.renew(token, now); }
  /// Keeps the bytes when the outcome is kCommitted.
  CommitOutcome commit(const CommitHeader& header, const std::string& worker_name, std::vector<std::byte> bytes);
  bool fail_task(const TaskFailure& failure);
  void expire(Time now);
  void release(const std::string& worker);

  bool all_committed() const { return leases_.finished(); }
  std::optional<JobFailure> verdict() const { return leases_.verdict(); }
  std::optional<Time> next_expiry() const { return leases_.next_expiry(); }
  /// Workers of one build and fingerprint run a job. Any may, as long as no task is leased or committed.
  bool accepts(const std::string& worker_class) const;

  JobState state() const { return state_; }
  const std::string& id() const { return id_; }
  const JobSpec& spec() const { return spec_; }
  const TaskInputs& inputs() const { return inputs_; }
  JobStatus status() const;
  void set_worker_class(const std::string& worker_class) { worker_class_ = worker_class; }
  std::vector<FarmFacts::Worker> worker_facts() const;
  /// Hands the results over; called once, when assembling.
  std::vector<std::vector<std::byte>> take_results() { return std::move(results_); }

 private:
  void enter(JobState state);

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
  std::vector<std::vector<std::byte>> results_;
  std::map<std::string, FarmFacts::Worker> workers_;  // by name
  std::string worker_class_;
  std::optional<JobFailure> failure_;
  std::vector<Artifact> artifacts_;
};

}  // namespace radfarm
