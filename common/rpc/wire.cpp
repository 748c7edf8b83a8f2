#include "rpc/wire.h"

#include <algorithm>
#include <set>

#include "base/digest.h"
#include "base/utf8.h"
#include "rpc/limits.h"

namespace radfarm {

std::string to_string(JobState state) { return v1::RenderJob::State_Name(static_cast<v1::RenderJob::State>(state)); }

std::string to_string(JobFailure::Reason reason) {
  return v1::Failure::Reason_Name(static_cast<v1::Failure::Reason>(reason));
}

namespace wire {
namespace {

tl::unexpected<Error> invalid(const std::string& field, const std::string& what) {
  return fail(Code::kInvalidArgument, field + ": " + what);
}

/// Names a field and the start of what is in it.
std::string quoted(const std::string& field, const std::string& value) {
  std::string text = field + " '";
  text.append(value, 0, 200);
  return text + "'";
}

Status check_length(const std::string& text, std::size_t low, std::size_t high, const std::string& field) {
  if (text.size() >= low && text.size() <= high) return {};
  return invalid(field, "has " + std::to_string(text.size()) + " bytes, must have " + std::to_string(low) + " to " +
                            std::to_string(high));
}

/// Names go to logs, terminals and JSON.
Status check_name(const std::string& name, std::size_t low, std::size_t high, const std::string& field) {
  RADFARM_TRY_STATUS(check_length(name, low, high, field));
  if (!is_utf8(name)) return invalid(field, "is not UTF-8");
  if (has_control_characters(name)) return invalid(field, "has control characters");
  return {};
}

Code code_from(std::uint32_t number) {
  return number >= 1 && number <= 16 ? static_cast<Code>(number) : Code::kUnknown;
}

Result<std::vector<SceneFile>> parse_files(const google::protobuf::RepeatedPtrField<v1::SceneFile>& messages) {
  if (messages.empty() || static_cast<std::size_t>(messages.size()) > limits::kSceneFiles) {
    return invalid("spec.files", "has " + std::to_string(messages.size()) + " files, must have 1 to " +
                                     std::to_string(limits::kSceneFiles));
  }
  std::vector<SceneFile> files;
  std::set<std::string> paths;
  std::uint64_t total = 0;
  for (const v1::SceneFile& message : messages) {
    RADFARM_TRY_STATUS(check_relative_path(message.path()));
    RADFARM_TRY_STATUS(check_digest(message.digest(), "spec.files.digest"));
    if (!paths.insert(message.path()).second) return invalid(quoted("spec.files", message.path()), "is given twice");
    if (message.size() > limits::kSceneBytes - total) {
      return fail(Code::kResourceExhausted,
                  "spec.files: more than " + std::to_string(limits::kSceneBytes) + " bytes in all");
    }
    total += message.size();
    files.push_back({message.path(), {message.digest(), message.size()}});
  }
  return files;
}

}  // namespace

Status check_digest(const std::string& digest, const std::string& field) {
  if (is_sha256_hex(digest)) return {};
  return invalid(quoted(field, digest), "is not a SHA-256 digest of 64 lower-case hexadecimal digits");
}

Status check_relative_path(const std::string& path) {
  const auto refuse = [&](const char* why) { return invalid(quoted("path", path), why); };
  if (path.empty() || path.size() > limits::kPathBytes) return refuse("is empty or too long");
  if (!is_utf8(path)) return invalid("path", "is not UTF-8");
  const auto is_bad = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == 0x7f; };
  if (std::any_of(path.begin(), path.end(), is_bad)) return refuse("has control characters or backslashes");
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..")
      return refuse("must be relative, without empty, '.' or '..' parts");
    begin = end + 1;
  }
  return {};
}

Result<JobSpec> parse(const v1::RenderJobSpec& message) {
  RADFARM_TRY_STATUS(check_name(message.display_name(), 0, limits::kNameBytes, "spec.display_name"));
  RADFARM_TRY_STATUS(
      check_length(message.render_request_json(), 2, limits::kRequestJsonBytes, "spec.render_request_json"));
  RADFARM_TRY(std::vector<SceneFile> files, parse_files(message.files()));
  const auto is_entry = [&](const SceneFile& file) { return file.path == message.entry_path(); };
  if (std::none_of(files.begin(), files.end(), is_entry)) return invalid("spec.entry_path", "is not one of spec.files");
  return JobSpec{message.display_name(), std::move(files), message.entry_path(), message.render_request_json()};
}

void encode(const JobSpec& spec, v1::RenderJobSpec& message) {
  message.set_display_name(spec.display_name);
  for (const SceneFile& file : spec.files) {
    v1::SceneFile& added = *message.add_files();
    added.set_path(file.path);
    added.set_digest(file.blob.digest);
    added.set_size(file.blob.size);
  }
  message.set_entry_path(spec.entry_path);
  message.set_render_request_json(spec.render_request_json);
}

Result<JobStatus> parse(const v1::RenderJob& message) {
  if (message.state() < v1::RenderJob::QUEUED || message.state() > v1::RenderJob::CANCELLED) {
    return invalid("job.state", "this client is older than the server and does not know it");
  }
  JobStatus status{message.id(),
                   message.display_name(),
                   static_cast<JobState>(message.state()),
                   message.revision(),
                   message.create_time().seconds(),
                   {},
                   {},
                   {}};
  const v1::Progress& progress = message.progress();
  status.progress = {progress.tasks_total(),     progress.tasks_committed(),  progress.tasks_leased(),
                     progress.attempts_failed(), progress.attempts_expired(), progress.results_diverged(),
                     progress.waiting_for(),
                     {progress.phase(), progress.phase_done(), progress.phase_total()},
                     progress.round()};
  status.target_missed = message.target_missed();
  status.cpu_seconds = message.cpu_s();
  for (const v1::Estimate& estimate : message.estimates()) {
    RADFARM_TRY_STATUS(check_name(estimate.ask(), 1, limits::kIdBytes, "job.estimates.ask"));
    status.estimates.push_back({estimate.ask(), estimate.cpu_low_s(), estimate.cpu_high_s()});
  }
  const v1::Failure& failure = message.failure();
  status.failure = {static_cast<JobFailure::Reason>(failure.reason()), {code_from(failure.code()), failure.message()}};
  for (const v1::Artifact& artifact : message.artifacts()) {
    RADFARM_TRY_STATUS(check_digest(artifact.digest(), "job.artifacts.digest"));
    status.artifacts.push_back({artifact.name(), {artifact.digest(), artifact.size()}});
  }
  return status;
}

void encode(const JobStatus& status, v1::RenderJob& message) {
  message.set_id(status.id);
  message.set_display_name(status.display_name);
  message.set_state(static_cast<v1::RenderJob::State>(status.state));
  message.set_revision(status.revision);
  message.mutable_create_time()->set_seconds(status.created_unix_seconds);
  v1::Progress& progress = *message.mutable_progress();
  progress.set_tasks_total(status.progress.tasks_total);
  progress.set_tasks_committed(status.progress.tasks_committed);
  progress.set_tasks_leased(status.progress.tasks_leased);
  progress.set_attempts_failed(status.progress.attempts_failed);
  progress.set_attempts_expired(status.progress.attempts_expired);
  progress.set_results_diverged(status.progress.results_diverged);
  progress.set_waiting_for(status.progress.waiting_for);
  progress.set_phase(status.progress.phase.name);
  progress.set_phase_done(status.progress.phase.done);
  progress.set_phase_total(status.progress.phase.total);
  progress.set_round(status.progress.round);
  message.set_target_missed(status.target_missed);
  message.set_cpu_s(status.cpu_seconds);
  for (const CostEstimate& estimate : status.estimates) {
    v1::Estimate& added = *message.add_estimates();
    added.set_ask(estimate.ask);
    added.set_cpu_low_s(estimate.cpu_low_seconds);
    added.set_cpu_high_s(estimate.cpu_high_seconds);
  }
  if (status.state == JobState::kFailed) {
    message.mutable_failure()->set_reason(static_cast<v1::Failure::Reason>(status.failure.reason));
    message.mutable_failure()->set_code(static_cast<std::uint32_t>(status.failure.error.code));
    message.mutable_failure()->set_message(status.failure.error.message);
  }
  for (const Artifact& artifact : status.artifacts) {
    v1::Artifact& added = *message.add_artifacts();
    added.set_name(artifact.name);
    added.set_digest(artifact.blob.digest);
    added.set_size(artifact.blob.size);
  }
}

Result<WorkerHello> parse(const v1::RegisterWorkerRequest& message) {
  RADFARM_TRY_STATUS(check_name(message.name(), 1, limits::kIdBytes, "name"));
  RADFARM_TRY_STATUS(check_length(message.build(), 1, limits::kNameBytes, "build"));
  RADFARM_TRY_STATUS(check_length(message.fingerprint(), 1, limits::kNameBytes, "fingerprint"));
  if (message.threads() < 1 || message.threads() > limits::kWorkerThreads) {
    return invalid("threads", std::to_string(message.threads()) + " is not between 1 and 1024");
  }
  return WorkerHello{message.name(), message.build(), message.fingerprint(), message.threads(), message.pid()};
}

void encode(const WorkerHello& hello, v1::RegisterWorkerRequest& message) {
  message.set_name(hello.name);
  message.set_build(hello.build);
  message.set_fingerprint(hello.fingerprint);
  message.set_threads(hello.threads);
  message.set_pid(hello.pid);
}

Result<Lease> parse(const v1::Lease& message) {
  RADFARM_TRY_STATUS(check_digest(message.inputs().scene_digest(), "inputs.scene_digest"));
  RADFARM_TRY_STATUS(check_digest(message.inputs().view_digest(), "inputs.view_digest"));
  if (!message.inputs().solution_digest().empty()) {
    RADFARM_TRY_STATUS(check_digest(message.inputs().solution_digest(), "inputs.solution_digest"));
  }
  const Task task{static_cast<Task::Kind>(message.task().kind()), message.task().index()};
  const TaskInputs inputs{message.inputs().scene_digest(), message.inputs().solution_digest(),
                          message.inputs().view_digest()};
  const v1::Round& given = message.round();
  const Round round{given.number(), given.audit_pixels(), given.audit_samples(), given.scale()};
  RADFARM_TRY_STATUS(check(round));
  if (!message.before_digest().empty()) RADFARM_TRY_STATUS(check_digest(message.before_digest(), "before_digest"));
  return Lease{message.job_id(), message.slot(), task, inputs, message.attempt(), message.token(), round,
               message.before_digest()};
}

void encode(const Lease& lease, v1::Lease& message) {
  message.set_job_id(lease.job_id);
  message.set_slot(lease.slot);
  message.mutable_task()->set_kind(static_cast<std::uint32_t>(lease.task.kind));
  message.mutable_task()->set_index(lease.task.index);
  message.mutable_inputs()->set_scene_digest(lease.inputs.scene);
  message.mutable_inputs()->set_solution_digest(lease.inputs.solution);
  message.mutable_inputs()->set_view_digest(lease.inputs.view);
  message.set_attempt(lease.attempt);
  message.set_token(lease.token);
  message.mutable_round()->set_number(lease.round.number);
  message.mutable_round()->set_audit_pixels(lease.round.audit_pixels);
  message.mutable_round()->set_audit_samples(lease.round.audit_samples);
  message.mutable_round()->set_scale(lease.round.scale);
  message.set_before_digest(lease.before);
}

Result<CommitHeader> parse(const v1::CommitTaskRequest::Header& message) {
  RADFARM_TRY_STATUS(check_digest(message.digest(), "header.digest"));
  if (message.size() > limits::kResultBytes) {
    return fail(Code::kResourceExhausted, "header.size: " + std::to_string(message.size()) +
                                              " bytes; a task's result may have " +
                                              std::to_string(limits::kResultBytes));
  }
  const double cpu_seconds = message.cpu_seconds() >= 0 && message.cpu_seconds() < 1e9 ? message.cpu_seconds() : 0;
  return CommitHeader{message.worker_id(),
                      message.job_id(),
                      message.slot(),
                      message.token(),
                      {message.digest(), message.size()},
                      cpu_seconds,
                      message.peak_memory_bytes(),
                      message.round()};
}

void encode(const CommitHeader& header, v1::CommitTaskRequest::Header& message) {
  message.set_worker_id(header.worker_id);
  message.set_job_id(header.job_id);
  message.set_slot(header.slot);
  message.set_token(header.token);
  message.set_digest(header.result.digest);
  message.set_size(header.result.size);
  message.set_cpu_seconds(header.cpu_seconds);
  message.set_peak_memory_bytes(header.peak_memory_bytes);
  message.set_round(header.round);
}

Result<TaskFailure> parse(const v1::FailTaskRequest& message) {
  if (message.failure_class() < v1::FailTaskRequest::TASK || message.failure_class() > v1::FailTaskRequest::DATA) {
    return invalid("failure_class", "must be TASK, WORKER, PREEMPTED or DATA");
  }
  return TaskFailure{message.worker_id(),
                     message.job_id(),
                     message.slot(),
                     message.token(),
                     static_cast<FailureClass>(message.failure_class()),
                     {code_from(message.code()), message.message().substr(0, 1000)}};
}

void encode(const TaskFailure& failure, v1::FailTaskRequest& message) {
  message.set_worker_id(failure.worker_id);
  message.set_job_id(failure.job_id);
  message.set_slot(failure.slot);
  message.set_token(failure.token);
  message.set_failure_class(static_cast<v1::FailTaskRequest::Class>(failure.failure_class));
  message.set_code(static_cast<std::uint32_t>(failure.error.code));
  message.set_message(failure.error.message.substr(0, 1000));
}

}  // namespace wire
}  // namespace radfarm
