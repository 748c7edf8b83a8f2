#include "coordinator/stages.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/stopwatch.h"
#include "coordinator/prepare_child.h"
#include "frame/request.h"
#include "image/exr.h"
#include "process/child_process.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;
using Reason = JobFailure::Reason;

// The end of a round, an image written included, in times of what its assembly took so far.
constexpr double kAssemblies = 2;

/// As many digits as bring the same number back.
std::string exact(double number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

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

/// What may be asked of a view and what it is expected to cost, as the preparation found; nothing where that cannot be read.
std::vector<CostEstimate> estimates_of(std::span<const std::byte> view) {
  std::vector<CostEstimate> estimates;
  const Result<nlohmann::json> expected = expected_cost_of(view);
  if (!expected) return estimates;
  const auto add = [&](const std::string& ask, const nlohmann::json& row) {
    const nlohmann::json range = row.value("cpu_s", nlohmann::json());
    if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number()) return;
    estimates.push_back({ask, range[0].get<double>(), range[1].get<double>()});
  };
  add("this job", *expected);
  for (const nlohmann::json& row : expected->value("others", nlohmann::json::array())) add(row.value("ask", "?"), row);
  return estimates;
}

Result<PreparedJob> collect(const fs::path& folder, const std::optional<Round>& round, const BlobStore& blobs) {
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
  RADFARM_TRY(job.round, first_round(file.bytes()));
  if (round) job.round = *round;
  RADFARM_TRY(job.tasks, cut_tasks(file.bytes(), job.round));
  job.estimates = estimates_of(file.bytes());
  return job;
}

/// What the child is told besides the scene and the request.
void add_effort(const ToPrepare& job, std::vector<std::string>& arguments) {
  const auto add = [&](const char* flag, const std::string& value) { arguments.insert(arguments.end(), {flag, value}); };
  if (job.target.error > 0) add("--error", exact(job.target.error));
  if (job.effort.level) add("--level", exact(static_cast<double>(*job.effort.level)));
  if (job.effort.by_paths) arguments.emplace_back("--by-paths");
  add("--threads", std::to_string(job.effort.threads));
}

}  // namespace

tl::expected<PreparedJob, JobFailure> prepare_job(const ToPrepare& job, const BlobStore& blobs,
                                                  const PrepareOptions& options, const std::stop_token& stop,
                                                  const std::function<void(const JobPhase&)>& on_phase) {
  const Result<ScratchFolder> scratch = make_scratch(options.scratch);
  if (!scratch) return broken(Reason::kInternal, scratch.error());
  const fs::path& folder = scratch->path();
  const fs::path scene = folder / "scene";
  if (const Status laid = lay_out(job.spec, blobs, scene); !laid) return broken(Reason::kSceneInvalid, laid.error());
  std::vector<std::string> arguments = {"prepare-child",
                                              "--scene",
                                              (scene / job.spec.entry_path).string(),
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
  add_effort(job, arguments);
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
  Result<PreparedJob> prepared = collect(folder, job.round, blobs);
  if (!prepared) return broken(Reason::kInternal, prepared.error());
  return std::move(*prepared);
}

namespace {

Result<std::vector<std::vector<std::byte>>> read_results(const std::vector<BlobRef>& blob_refs, const BlobStore& blobs) {
  std::vector<std::vector<std::byte>> results;
  for (const BlobRef& blob : blob_refs) {
    RADFARM_TRY(const MappedFile file, blobs.read(blob.digest));
    results.emplace_back(file.bytes().begin(), file.bytes().end());
  }
  return results;
}

/// Where the integrator, and all that depends on it, is ours to choose.
bool may_trace_paths(const JobSpec& spec) {
  const nlohmann::json json = nlohmann::json::parse(spec.render_request_json, nullptr, /*allow_exceptions=*/false);
  const Result<RenderRequest> request = render_request_from_json(json);
  return request && request->integrator == RenderRequest::Integrator::kAuto && request->gather == Gather::kDefault &&
         request->aov.empty();
}

/// With what the farm measured.
RoundFigures figures_of(const ToAssemble& job, const AssembledRound& round) {
  RoundFigures figures = round.figures();
  figures.kind = job.kind;
  figures.light_cpu_seconds = job.light_cpu_seconds;
  figures.audit_cpu_seconds = job.audit_cpu_seconds;
  figures.wall_seconds = job.wall_seconds;
  if (job.kind == RoundFigures::Kind::kMoreSamples) figures.prepare_cpu_seconds = figures.prepare_wall_seconds = 0;
  return figures;
}

Result<std::vector<Artifact>> store_artifacts(const Finished& finished, const BlobStore& blobs) {
  RADFARM_TRY(const std::vector<std::byte> exr, encode_exr(finished.image));
  RADFARM_TRY(const BlobRef image, blobs.put(exr));
  const std::string text = finished.report->dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  RADFARM_TRY(const BlobRef report, blobs.put(std::as_bytes(std::span(text))));
  return std::vector<Artifact>{{"image.exr", image}, {"report.json", report}};
}

Result<AssembledJob> assemble(const ToAssemble& job, const BlobStore& blobs) {
  const Stopwatch watch;
  RADFARM_TRY(const MappedFile view, blobs.read(job.inputs.view));
  RADFARM_TRY(const std::vector<std::vector<std::byte>> results, read_results(job.results, blobs));
  RADFARM_TRY(AssembledRound round, assemble_round(view.bytes(), job.round, results));
  AssembledJob assembled;
  assembled.figures = figures_of(job, round);
  JobFacts facts{job.farm, job.target, {}, job.rounds, 0};
  facts.rounds.push_back(assembled.figures);
  RoundsAsked asked{job.target, may_trace_paths(job.spec), job.rounds_left, 0, kAssemblies * watch.wall_seconds()};
  asked.seconds_left = job.target.seconds - job.elapsed_seconds - watch.wall_seconds();
  assembled.next = next_round(asked, facts.rounds);
  if (assembled.next.step == NextRound::Step::kMoreSamples) {
    RADFARM_TRY(assembled.tasks, cut_tasks(view.bytes(), assembled.next.round));
  }
  if (assembled.next.step != NextRound::Step::kStop) return assembled;
  facts.target_met = assembled.next.target_met;
  facts.elapsed_seconds = job.elapsed_seconds + watch.wall_seconds();
  RADFARM_TRY(assembled.artifacts, store_artifacts(finish(std::move(round), std::move(facts)), blobs));
  return assembled;
}

}  // namespace

tl::expected<AssembledJob, JobFailure> assemble_job(const ToAssemble& job, const BlobStore& blobs) {
  Result<AssembledJob> assembled = assemble(job, blobs);
  if (!assembled) return broken(Reason::kResultInvalid, assembled.error());
  return std::move(*assembled);
}

}  // namespace radfarm
