#include "coordinator/prepare_child.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <iostream>
#include <mutex>
#include <new>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/log.h"
#include "base/utf8.h"
#include "frame/request.h"
#include "pipeline/pipeline.h"
#include "process/exit_code.h"
#include "process/signals.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

/// Called when an allocation fails: says so without allocating, and ends the process.
void out_of_memory() {
  constexpr const char* kLine =
      "{\"code\":8,\"message\":\"preparing the scene needs more memory than the coordinator allows "
      "(--prepare-memory-bytes)\"}\n";
  (void)!::write(STDOUT_FILENO, kLine, std::strlen(kLine));
  ::_exit(kOutOfMemoryExit);
}

void limit_memory(std::uint64_t bytes) {
  std::set_new_handler(out_of_memory);
  if (bytes == 0) return;
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
}

Result<RenderRequest> read_request(const std::filesystem::path& path) {
  RADFARM_TRY(const std::string text, read_file(path, limits::kRequestJsonBytes));
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return fail(Code::kInvalidArgument, "render request: is not JSON");
  return render_request_from_json(json);
}

/// Prints how far the preparation is, as often as a person can read it.
class PhasePrinter {
 public:
  void operator()(std::string_view phase, std::uint64_t done, std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (phase == phase_ && (now - printed_ < kInterval || done <= done_)) return;
    phase_ = phase;
    done_ = done;
    printed_ = now;
    const std::string line = nlohmann::json{{"phase", phase_}, {"done", done}, {"total", total}}.dump() + "\n";
    (void)!::write(STDOUT_FILENO, line.data(), line.size());
  }

 private:
  static constexpr std::chrono::milliseconds kInterval{200};
  std::mutex mutex_;
  std::string phase_;
  std::uint64_t done_ = 0;
  std::chrono::steady_clock::time_point printed_;
};

Effort effort_of(const PrepareChildOptions& options) {
  Effort effort{{}, options.by_paths, options.threads};
  if (options.level >= 0) effort.level = static_cast<float>(options.level);
  return effort;
}

Status prepare_files(const PrepareChildOptions& options) {
  RADFARM_TRY_STATUS(die_with_parent(options.parent_pid));
  RADFARM_TRY(RenderRequest request, read_request(options.request));
  if (options.error > 0) {
    request.error = options.error;
    request.time.reset();
    request.audit = true;
  }
  RADFARM_TRY_STATUS(validate(request));
  PhasePrinter print;
  const PrepareContext context{{options.solutions, options.solution_bytes}, Progress(std::ref(print))};
  RADFARM_TRY(const PreparedFiles files, prepare(options.scene, request, context, effort_of(options)));
  context.progress.report("store");
  RADFARM_TRY_STATUS(write_file_atomically(options.out / kSceneFile, files.scene));
  RADFARM_TRY_STATUS(write_file_atomically(options.out / kSolutionFile, files.solution));
  return write_file_atomically(options.out / kViewFile, files.view);
}

/// The message without the folder that only this job has ever had.
std::string without_folder(std::string message, const std::filesystem::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) {
    message.erase(at, prefix.size());
  }
  return message;
}

}  // namespace

int run_prepare_child(const PrepareChildOptions& options) {
  start_logging("radfarm-coordinator prepare-child", spdlog::level::warn);
  limit_memory(options.memory_bytes);
  const Status done = prepare_files(options);
  if (done) return static_cast<int>(ExitCode::kDone);
  const nlohmann::json line = {{"code", static_cast<int>(done.error().code)},
                               {"message", without_folder(done.error().message, options.out / "scene")}};
  std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  return static_cast<int>(exit_code_for(done.error().code));
}

std::optional<Error> parse_child_error(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("code") || !json.contains("message")) return std::nullopt;
  if (!json["code"].is_number_integer() || !json["message"].is_string()) return std::nullopt;
  const int code = json["code"].get<int>();
  return Error{code >= 1 && code <= 16 ? static_cast<Code>(code) : Code::kUnknown, json["message"].get<std::string>()};
}

std::optional<JobPhase> parse_child_phase(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("phase") || !json["phase"].is_string()) return std::nullopt;
  JobPhase phase{json["phase"].get<std::string>(), 0, 0};
  if (phase.name.size() > limits::kIdBytes || !is_utf8(phase.name) || has_control_characters(phase.name)) return std::nullopt;
  const auto count = [&](const char* key) {
    return json.contains(key) && json[key].is_number_unsigned() ? json[key].get<std::uint64_t>() : 0;
  };
  phase.done = count("done");
  phase.total = count("total");
  return phase;
}

}  // namespace radfarm
