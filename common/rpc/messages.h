#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/status.h"
#include "frame/round.h"
#include "frame/task.h"

namespace radfarm {

/// What the services exchange, as plain structs; wire.h turns them into protos and back. Meanings: proto/radfarm/v1.

struct BlobRef {
  std::string digest;  // SHA-256, see is_sha256_hex
  std::uint64_t size = 0;
  friend bool operator==(const BlobRef&, const BlobRef&) = default;
};

struct SceneFile {
  std::string path;  // relative to the scene's folder
  BlobRef blob;
  friend bool operator==(const SceneFile&, const SceneFile&) = default;
};

struct JobSpec {
  std::string display_name;
  std::vector<SceneFile> files;
  std::string entry_path;
  std::string render_request_json;
  friend bool operator==(const JobSpec&, const JobSpec&) = default;
};

enum class JobState { kQueued = 1, kPreparing, kRendering, kAssembling, kSucceeded, kFailed, kCancelling, kCancelled };

constexpr bool is_terminal(JobState state) {
  return state == JobState::kSucceeded || state == JobState::kFailed || state == JobState::kCancelled;
}
/// "RENDERING", as in the protocol.
std::string to_string(JobState state);

struct JobFailure {
  enum class Reason { kSceneInvalid = 1, kPrepareDied, kTaskFailed, kTaskLost, kResultInvalid, kInternal };
  Reason reason = Reason::kInternal;
  Error error;
  friend bool operator==(const JobFailure&, const JobFailure&) = default;
};

/// "SCENE_INVALID", as in the protocol.
std::string to_string(JobFailure::Reason reason);

/// How far the preparation is. `total` is 0 where it is not known.
struct JobPhase {
  std::string name;  // "radiosity: links"; empty: not being prepared
  std::uint64_t done = 0;
  std::uint64_t total = 0;
  friend bool operator==(const JobPhase&, const JobPhase&) = default;
};

struct JobProgress {
  std::uint32_t tasks_total = 0;
  std::uint32_t tasks_committed = 0;
  std::uint32_t tasks_leased = 0;
  std::uint32_t attempts_failed = 0;
  std::uint32_t attempts_expired = 0;
  std::uint32_t results_diverged = 0;
  std::string waiting_for;
  JobPhase phase;
  std::uint32_t round = 0;  // 1 for the first
  friend bool operator==(const JobProgress&, const JobProgress&) = default;
};

struct Artifact {
  std::string name;
  BlobRef blob;
  friend bool operator==(const Artifact&, const Artifact&) = default;
};

/// Expected CPU seconds of what might be asked for.
struct CostEstimate {
  std::string ask;
  double cpu_low_seconds = 0;
  double cpu_high_seconds = 0;
  friend bool operator==(const CostEstimate&, const CostEstimate&) = default;
};

struct JobStatus {
  std::string id;
  std::string display_name;
  JobState state = JobState::kQueued;
  std::uint64_t revision = 0;
  std::int64_t created_unix_seconds = 0;
  JobProgress progress;
  JobFailure failure;  // meaningful iff state is kFailed
  std::vector<Artifact> artifacts;
  bool target_missed = false;
  std::vector<CostEstimate> estimates = {};
  double cpu_seconds = 0;
};

struct WorkerHello {
  std::string name;
  std::string build;
  std::string fingerprint;
  std::uint32_t threads = 1;
  std::uint32_t pid = 0;
};

struct WorkerWelcome {
  std::string worker_id;
  std::chrono::milliseconds lease_length{0};
};

struct TaskInputs {
  std::string scene;     // digests
  std::string solution;  // empty: none
  std::string view;
  friend bool operator==(const TaskInputs&, const TaskInputs&) = default;
};

struct Lease {
  std::string job_id;
  std::uint32_t slot = 0;  // position in cut_tasks order
  Task task;
  TaskInputs inputs;
  std::uint32_t attempt = 0;
  std::string token;
  Round round = {};
  std::string before = {};  // digest of the same task's result in the round before; empty: it starts anew
  friend bool operator==(const Lease&, const Lease&) = default;
};

enum class CommitOutcome { kCommitted = 1, kDuplicate, kSuperseded };

/// What a worker says of a result it hands in.
struct CommitHeader {
  std::string worker_id;
  std::string job_id;
  std::uint32_t slot = 0;
  std::string token;
  BlobRef result;
  double cpu_seconds = 0;
  std::int64_t peak_memory_bytes = 0;
  std::uint32_t round = 0;
};

enum class FailureClass { kTask = 1, kWorker, kPreempted, kData };

struct TaskFailure {
  std::string worker_id;
  std::string job_id;
  std::uint32_t slot = 0;
  std::string token;
  FailureClass failure_class = FailureClass::kTask;
  Error error;
};

}  // namespace radfarm
