#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "coordinator/blob_store.h"
#include "coordinator/prepared_job.h"
#include "frame/task.h"
#include "pipeline/next_round.h"
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

/// What is prepared: a job's view as its specification has it, or anew for a target.
struct ToPrepare {
  JobSpec spec;
  Target target;
  Effort effort;
  std::optional<Round> round;  // the first one of this view; nothing: as prepared
};

/// Lays the scene out in a folder of its own and prepares it in a child process, so that a hostile or enormous scene
/// fails its own job and nothing else. `stop` kills the child. `on_phase` hears how far it is, on the caller's thread.
tl::expected<PreparedJob, JobFailure> prepare_job(const ToPrepare& job, const BlobStore& blobs,
                                                  const PrepareOptions& options, const std::stop_token& stop,
                                                  const std::function<void(const JobPhase&)>& on_phase);

/// A round whose tasks are all committed.
struct ToAssemble {
  JobSpec spec;
  TaskInputs inputs;
  Round round;
  RoundFigures::Kind kind = RoundFigures::Kind::kFirst;
  std::vector<BlobRef> results;      // in cut_tasks order
  std::vector<RoundFigures> rounds;  // before this one
  Target target;
  std::uint32_t rounds_left = 0;
  double light_cpu_seconds = 0, audit_cpu_seconds = 0, wall_seconds = 0;  // of this round
  double elapsed_seconds = 0;        // since the job was first prepared
  FarmFacts farm;                    // of all rounds
};

/// What a round came to: what comes next, with its tasks where samples go on; or "image.exr" and "report.json", stored as blobs.
struct AssembledJob {
  RoundFigures figures;
  NextRound next;
  std::vector<Task> tasks;
  std::vector<Artifact> artifacts;
};

tl::expected<AssembledJob, JobFailure> assemble_job(const ToAssemble& job, const BlobStore& blobs);

}  // namespace radfarm
