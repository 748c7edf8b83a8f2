#include "coordinator/stages.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "coordinator/prepare_child.h"
#include "image/exr.h"
#include "process/child_process.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;
using Reason = JobFailure::Reason;

/// A folder that goes away with all it holds.
class ScratchFolder {
 public:
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}
  ~ScratchFolder() {
    std::error_code ignored;  // what cannot be removed now is removed at the next start
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Result<ScratchFolder> make_scratch(const fs::path& parent) {
  std::string path = (parent / "job.XXXXXX").string();
  if (::mkdtemp(path.data()) == nullptr) return fail(Code::kInternal, path + ": cannot create a job folder");
  return ScratchFolder(path);
}

Status lay_out(const JobSpec& spec, const BlobStore& blobs, const fs::path& folder) {
  for (const SceneFile& file : spec.files) {
    const fs::path target = folder / file.path;
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error) return fail(Code::kInvalidArgument, file.path + ": is both a file and a folder");
    RADFARM_TRY_STATUS(blobs.link_to(file.blob.digest, target));
  }
  return write_file_atomically(folder.parent_path() / "request.json", spec.render_request_json);
}

tl::unexpected<JobFailure> broken(Reason reason, Error error) {
  return tl::unexpected(JobFailure{reason, std::move(error)});
}

/// Hears what the child says until it ends or time is over; the error among it, if there is one.
std::optional<Error> listen(ChildProcess& child, std::chrono::steady_clock::time_point deadline,
                            const std::function<void(const JobPhase&)>& on_phase) {
  std::optional<Error> said;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const Result<std::string> line = child.read_line(left);
    if (!line) return said;
    if (const std::optional<JobPhase> phase = parse_child_phase(*line)) on_phase(*phase);
    if (std::optional<Error> error = parse_child_error(*line)) said = std::move(error);
  }
}

/// The child's last word, or what its end says when it left none.
tl::unexpected<JobFailure> failure_of(const std::optional<Error>& said, const ChildProcess::Exit& exit) {
  if (said && !exit.by_signal) {
    const bool memory = said->code == Code::kResourceExhausted && exit.number == kOutOfMemoryExit;
    return broken(memory ? Reason::kPrepareDied : Reason::kSceneInvalid, *said);
  }
  return broken(Reason::kPrepareDied, {Code::kInternal, "preparing the scene " + to_string(exit)});
}

Result<PreparedJob> collect(const fs::path& folder, const BlobStore& blobs) {
  PreparedJob job;
  const auto store = [&](const char* name) -> Result<BlobRef> {
    RADFARM_TRY(const MappedFile file, MappedFile::open(folder / name));
    return blobs.put(file.bytes());
  };
  RADFARM_TRY(const BlobRef scene, store(kSceneFile));
  RADFARM_TRY(const BlobRef solution, store(kSolutionFile));
  RADFARM_TRY(const BlobRef view, store(kViewFile));
  job.inputs = {scene.digest, solution.size > 0 ? solution.digest : "", view.digest};
  RADFARM_TRY(const MappedFile file, blobs.read(view.digest));
  RADFARM_TRY(job.tasks, cut_tasks(file.bytes()));
  return job;
}

}  // namespace

tl::expected<PreparedJob, JobFailure> prepare_job(const JobSpec& spec, const BlobStore& blobs,
                                                  const PrepareOptions& options, const std::stop_token& stop,
                                                  const std::function<void(const JobPhase&)>& on_phase) {
  const Result<ScratchFolder> scratch = make_scratch(options.scratch);
  if (!scratch) return broken(Reason::kInternal, scratch.error());
  const fs::path& folder = scratch->path();
  const fs::path scene = folder / "scene";
  if (const Status laid = lay_out(spec, blobs, scene); !laid) return broken(Reason::kSceneInvalid, laid.error());
  const std::vector<std::string> arguments = {"prepare-child",
                                              "--scene",
                                              (scene / spec.entry_path).string(),
                                              "--request",
                                              (folder / "request.json").string(),
                                              "--out",
                                              folder.string(),
                                              "--solutions",
                                              options.solutions.string(),
                                              "--solution-bytes",
                                              std::to_string(options.solution_bytes),
                                              "--memory-bytes",
                                              std::to_string(options.memory_bytes),
                                              "--parent-pid",
                                              std::to_string(::getpid())};
  Result<ChildProcess> child = ChildProcess::start(options.program, arguments, ChildProcess::Stdout::kCapture);
  if (!child) return broken(Reason::kInternal, child.error());

  const std::stop_callback kill(stop, [&] { child->signal(SIGKILL); });
  const auto deadline = std::chrono::steady_clock::now() + options.time_limit;
  const std::optional<Error> said = listen(*child, deadline, on_phase);
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  const std::optional<ChildProcess::Exit> exit = child->wait(left);
  if (!exit) {
    return broken(Reason::kPrepareDied,
                  {Code::kDeadlineExceeded, "preparing the scene took longer than " +
                                                std::to_string(options.time_limit.count()) + " s (--prepare-seconds)"});
  }
  if (*exit != ChildProcess::Exit{false, 0}) return failure_of(said, *exit);
  Result<PreparedJob> job = collect(folder, blobs);
  if (!job) return broken(Reason::kInternal, job.error());
  return std::move(*job);
}

tl::expected<std::vector<Artifact>, JobFailure> assemble_job(const TaskInputs& inputs, const BlobStore& blobs,
                                                             const std::vector<std::vector<std::byte>>& results,
                                                             const FarmFacts& facts) {
  const auto assemble = [&]() -> Result<std::vector<Artifact>> {
    RADFARM_TRY(const MappedFile view, blobs.read(inputs.view));
    RADFARM_TRY(const Finished finished, finish(view.bytes(), results, facts));
    RADFARM_TRY(const std::vector<std::byte> exr, encode_exr(finished.image));
    RADFARM_TRY(const BlobRef image, blobs.put(exr));
    const std::string text = finished.report->dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    RADFARM_TRY(const BlobRef report, blobs.put(std::as_bytes(std::span(text))));
    return std::vector<Artifact>{{"image.exr", image}, {"report.json", report}};
  };
  Result<std::vector<Artifact>> artifacts = assemble();
  if (!artifacts) return broken(Reason::kResultInvalid, artifacts.error());
  return std::move(*artifacts);
}

}  // namespace radfarm
