#include "cli/local_farm.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "cli/solution_folder.h"

namespace radfarm::cli {
namespace {

constexpr std::chrono::seconds kStartLimit{30};
// A coordinator that assembles an image goes on until it is done; nobody waits for that.
constexpr std::chrono::milliseconds kEndLimit{200};
// Short, because a worker of this machine that falls silent is dead; renewed four times in between.
constexpr const char* kLeaseMs = "10000";

/// Stops what still runs; by the destructors it is gone for certain.
void end(std::vector<ChildProcess>& children) {
  for (const ChildProcess& child : children) child.signal(SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kEndLimit;
  for (ChildProcess& child : children) {
    const auto left = deadline - std::chrono::steady_clock::now();
    (void)child.wait(std::chrono::ceil<std::chrono::milliseconds>(left));
  }
  children.clear();
}

}  // namespace

Result<LocalFarm> LocalFarm::start(const Options& options) {
  RADFARM_TRY(TemporaryDirectory folder, TemporaryDirectory::create("radfarm-render"));
  LocalFarm farm(std::move(folder));
  RADFARM_TRY_STATUS(farm.start_coordinator(options));
  for (int i = 1; i <= options.workers; ++i) RADFARM_TRY_STATUS(farm.start_worker(i, options.threads));
  return farm;
}

LocalFarm::~LocalFarm() {
  // A worker in the middle of a task would first finish it; nobody waits for that result.
  for (const ChildProcess& worker : workers_) worker.signal(SIGKILL);
  end(workers_);
  end(coordinator_);
}

Status LocalFarm::start_coordinator(const Options& options) {
  const std::filesystem::path& solutions = options.solutions;
  const std::string solution_bytes = std::to_string(solutions.empty() ? 0 : kSolutionBytes);
  RADFARM_TRY(ChildProcess child,
              ChildProcess::start(executable_folder() / "radfarm-coordinator",
                                  {"serve", "--listen", "127.0.0.1:0", "--worker-listen", "127.0.0.1:0", "--data",
                                   (folder_.path() / "data").string(), "--lease-ms", kLeaseMs, "--solutions",
                                   solutions.string(), "--solution-bytes", solution_bytes, "--expected-threads",
                                   std::to_string(options.workers * options.threads), "--parent-pid",
                                   std::to_string(::getpid())},
                                  ChildProcess::Stdout::kCapture));
  coordinator_.push_back(std::move(child));
  const Result<std::string> line = coordinator_.front().read_line(kStartLimit);
  if (!line) return fail(Code::kInternal, "radfarm-coordinator did not start: " + line.error().message);
  const nlohmann::json json = nlohmann::json::parse(*line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return fail(Code::kInternal, "radfarm-coordinator said '" + *line + "' instead of its ports");
  address_ = json.value("address", "");
  worker_address_ = json.value("worker_address", "");
  return {};
}

Status LocalFarm::start_worker(int number, int threads) {
  RADFARM_TRY(ChildProcess child,
              ChildProcess::start(executable_folder() / "radfarm-worker",
                                  {"--coordinator", worker_address_, "--name", "worker-" + std::to_string(number),
                                   "--threads", std::to_string(threads), "--cache", (folder_.path() / "cache").string(),
                                   "--give-up-after", "20", "--parent-pid", std::to_string(::getpid())},
                                  ChildProcess::Stdout::kToStderr));
  workers_.push_back(std::move(child));
  return {};
}

Status LocalFarm::check() {
  const auto ended = [](ChildProcess& child) { return child.wait(std::chrono::milliseconds(0)); };
  if (const auto exit = ended(coordinator_.front())) {
    return fail(Code::kInternal, "radfarm-coordinator " + to_string(*exit));
  }
  std::optional<ChildProcess::Exit> last;
  for (ChildProcess& worker : workers_) {
    const auto exit = ended(worker);
    if (!exit) return {};
    last = exit;
  }
  return fail(Code::kInternal,
              "all workers have ended; the last one " + to_string(last.value_or(ChildProcess::Exit{})));
}

}  // namespace radfarm::cli
