// radfarm-worker: leases tasks from a coordinator and runs them.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "process/exit_code.h"
#include "process/signals.h"
#include "rpc/channel.h"
#include "rpc/limits.h"
#include "worker/worker_loop.h"

namespace radfarm {
namespace {

constexpr const char* kProgram = "radfarm-worker";

struct Flags {
  WorkerOptions worker;
  double patience_seconds = 60;
  int parent_pid = 0;
};

std::string default_name() {
  std::array<char, 256> host{};
  (void)::gethostname(host.data(), host.size() - 1);
  return std::string(host.data()).substr(0, 60) + "/" + std::to_string(::getpid());
}

Status work(Flags flags) {
  RADFARM_TRY_STATUS(rpc::check_address(flags.worker.coordinator, "--coordinator"));
  std::optional<TemporaryDirectory> own_cache;
  if (flags.worker.cache.empty()) {
    RADFARM_TRY(TemporaryDirectory folder, TemporaryDirectory::create("radfarm-worker"));
    flags.worker.cache = own_cache.emplace(std::move(folder)).path();
  }
  RADFARM_TRY(const BlobStore cache, BlobStore::open(flags.worker.cache, limits::kBlobBytes));
  const ThreadLimit threads(static_cast<int>(flags.worker.threads));
  flags.worker.patience = std::chrono::milliseconds(static_cast<long long>(1000 * flags.patience_seconds));
  WorkerLoop loop(flags.worker, cache);
  const SignalWatcher signals({SIGINT, SIGTERM}, [&](int) { loop.stop(); });
  return loop.run();
}

int run(int argc, char** argv) {
  CLI::App app("leases tasks of render jobs and runs them", kProgram);
  Flags flags;
  flags.worker.name = default_name();
  flags.worker.threads = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("--coordinator", flags.worker.coordinator, "HOST:PORT of the coordinator's worker port")->required();
  app.add_option("--name", flags.worker.name, "how reports and logs call this worker");
  app.add_option("--threads", flags.worker.threads, "tasks run at once")->check(CLI::Range(1U, limits::kWorkerThreads));
  app.add_option("--cache", flags.worker.cache, "folder for blobs, shared by this machine's workers; default: private");
  app.add_option("--give-up-after", flags.patience_seconds, "seconds without an answer before it ends with exit code 8")
      ->check(CLI::Range(0.5, 1e7));
  app.add_option("--parent-pid", flags.parent_pid, "end when this process ends, which must have started this one");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    report_error(kProgram, {Code::kInvalidArgument, std::string(error.what()) + "; see --help"});
    return static_cast<int>(ExitCode::kUsage);
  }
  block_signals({SIGINT, SIGTERM});
  start_logging(kProgram, spdlog::level::info);
  if (flags.parent_pid != 0) {
    if (const Status alive = die_with_parent(flags.parent_pid); !alive) {
      return static_cast<int>(report_error(kProgram, alive.error()));
    }
  }
  const Status worked = work(flags);
  return static_cast<int>(worked ? ExitCode::kDone : report_error(kProgram, worked.error()));
}

}  // namespace
}  // namespace radfarm

int main(int argc, char** argv) { return radfarm::run(argc, argv); }
