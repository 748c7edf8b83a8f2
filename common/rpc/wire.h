#pragma once

#include <string>

#include "base/status.h"
#include "radfarm/v1/render_jobs.pb.h"
#include "radfarm/v1/worker_control.pb.h"
#include "rpc/messages.h"

namespace radfarm::wire {

/// Plain structs to protos and back. parse_* checks everything that can be checked without state and names the field
/// that is wrong (INVALID_ARGUMENT); what it returns needs no more checking.

Result<JobSpec> parse(const v1::RenderJobSpec& message);
void encode(const JobSpec& spec, v1::RenderJobSpec& message);

Result<JobStatus> parse(const v1::RenderJob& message);
void encode(const JobStatus& status, v1::RenderJob& message);

Result<WorkerHello> parse(const v1::RegisterWorkerRequest& message);
void encode(const WorkerHello& hello, v1::RegisterWorkerRequest& message);

Result<Lease> parse(const v1::Lease& message);
void encode(const Lease& lease, v1::Lease& message);

Result<CommitHeader> parse(const v1::CommitTaskRequest::Header& message);
void encode(const CommitHeader& header, v1::CommitTaskRequest::Header& message);

Result<TaskFailure> parse(const v1::FailTaskRequest& message);
void encode(const TaskFailure& failure, v1::FailTaskRequest& message);

/// INVALID_ARGUMENT unless `path` may be created below a job's folder: relative, no "..", ".", empty parts, backslashes
/// or control characters.
Status check_relative_path(const std::string& path);
/// INVALID_ARGUMENT unless `digest` is 64 lower-case hexadecimal digits.
Status check_digest(const std::string& digest, const std::string& field);

}  // namespace radfarm::wire
