#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "coordinator/blob_store.h"
#include "frame/task.h"
#include "pipeline/pipeline.h"
#include "rpc/messages.h"

namespace radfarm {

/// The long steps of a job, run by the executor and free of the scheduler's state.

struct PrepareOptions {
  std::filesystem::path program;  // radfarm-coordinator, which runs itself as `prepare-child`
  std::filesystem::path scratch;  // job folders are made and removed here
  std::filesystem::path solutions;       // solved light of earlier jobs
  std::uint64_t solution_bytes = 0;      // of all together; 0: none is kept
  std::chrono::seconds time_limit{3600};
  std::uint64_t memory_bytes = 0;  // address space of the child; 0: no limit
};

struct PreparedJob {
  TaskInputs inputs;
  std::vector<Task> tasks;
};

/// Lays the scene out in a folder of its own and prepares it in a child process, so that a hostile or enormous scene
/// fails its own job and nothing else. `stop` kills the child. `on_phase` hears how far it is, on the caller's thread.
tl::expected<PreparedJob, JobFailure> prepare_job(const JobSpec& spec, const BlobStore& blobs,
                                                  const PrepareOptions& options, const std::stop_token& stop,
                                                  const std::function<void(const JobPhase&)>& on_phase);

/// Results (in cut_tasks order) to "image.exr" and "report.json", stored as blobs.
tl::expected<std::vector<Artifact>, JobFailure> assemble_job(const TaskInputs& inputs, const BlobStore& blobs,
                                                             const std::vector<std::vector<std::byte>>& results,
                                                             const FarmFacts& facts);

}  // namespace radfarm
