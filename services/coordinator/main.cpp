// radfarm-coordinator: keeps jobs and blobs, hands tasks to workers, answers clients.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <semaphore>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/log.h"
#include "coordinator/prepare_child.h"
#include "coordinator/server.h"
#include "process/child_process.h"
#include "process/exit_code.h"
#include "process/signals.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

constexpr const char* kProgram = "radfarm-coordinator";

struct ServeFlags {
  ServerOptions server;
  int lease_ms = 60000;
  int prepare_seconds = 3600;
  int parent_pid = 0;
};

std::uint64_t physical_memory() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void add_serve_flags(CLI::App& app, ServeFlags& flags) {
  ServerOptions& server = flags.server;
  server.max_blob_bytes = limits::kBlobBytes;
  server.scheduler.prepare.memory_bytes = physical_memory();
  server.scheduler.prepare.solution_bytes = std::uint64_t{4} << 30U;
  app.add_option("--listen", server.listen, "HOST:PORT for clients; port 0 lets the system choose");
  app.add_option("--worker-listen", server.worker_listen, "HOST:PORT for workers");
  app.add_option("--data", server.data, "folder for blobs; belongs to one coordinator at a time")->required();
  app.add_option("--max-blob-bytes", server.max_blob_bytes, "largest blob accepted");
  app.add_option("--lease-ms", flags.lease_ms, "length of a lease")->check(CLI::Range(200, 3600000));
  app.add_option("--prepare-seconds", flags.prepare_seconds, "time limit for preparing a scene")
      ->check(CLI::Range(1, 7 * 86400));
  app.add_option("--prepare-memory-bytes", server.scheduler.prepare.memory_bytes,
                 "address space of a preparing process; 0 for no limit");
  app.add_option("--solutions", server.scheduler.prepare.solutions,
                 "folder for solved light that later jobs use again; default: solutions in --data");
  app.add_option("--solution-bytes", server.scheduler.prepare.solution_bytes,
                 "of all solved light together, what was used longest ago goes first; 0 keeps none");
  app.add_option("--expected-threads", server.scheduler.expected_threads,
                 "worker threads that a target of --time is shared out over, at least; default: those registered")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--parent-pid", flags.parent_pid, "end when this process ends, which must have started this one");
}

int run_serve(ServeFlags flags) {
  block_signals({SIGINT, SIGTERM});
  std::counting_semaphore<> stop{0};
  const SignalWatcher signals({SIGINT, SIGTERM}, [&](int) { stop.release(); });
  start_logging(kProgram, spdlog::level::info);
  if (flags.parent_pid != 0) {
    if (const Status alive = die_with_parent(flags.parent_pid); !alive) {
      return static_cast<int>(report_error(kProgram, alive.error()));
    }
  }
  SchedulerOptions& scheduler = flags.server.scheduler;
  scheduler.leases.length = std::chrono::milliseconds(flags.lease_ms);
  scheduler.prepare.time_limit = std::chrono::seconds(flags.prepare_seconds);
  scheduler.prepare.program = executable_folder() / kProgram;
  const Status served = serve(flags.server, [&](const ServerAddresses& addresses) {
    // One line for whoever started us: scripts and `radfarm render` learn the ports from it.
    std::printf("{\"address\":\"%s\",\"worker_address\":\"%s\"}\n", addresses.clients.c_str(),
                addresses.workers.c_str());
    std::fflush(stdout);
    stop.acquire();
  });
  return static_cast<int>(served ? ExitCode::kDone : report_error(kProgram, served.error()));
}

int run(int argc, char** argv) {
  CLI::App app("keeps render jobs and hands their tasks to workers", kProgram);
  app.require_subcommand(1);
  ServeFlags serve_flags;
  add_serve_flags(*app.add_subcommand("serve", "serve until SIGTERM or SIGINT"), serve_flags);
  PrepareChildOptions child;
  CLI::App& prepare = *app.add_subcommand("prepare-child", "")->group("");
  prepare.add_option("--scene", child.scene)->required();
  prepare.add_option("--request", child.request)->required();
  prepare.add_option("--out", child.out)->required();
  prepare.add_option("--solutions", child.solutions);
  prepare.add_option("--solution-bytes", child.solution_bytes);
  prepare.add_option("--memory-bytes", child.memory_bytes);
  prepare.add_option("--parent-pid", child.parent_pid)->required();
  prepare.add_option("--error", child.error);
  prepare.add_option("--level", child.level);
  prepare.add_flag("--by-paths", child.by_paths);
  prepare.add_option("--threads", child.threads);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    report_error(kProgram, {Code::kInvalidArgument, std::string(error.what()) + "; see --help"});
    return static_cast<int>(ExitCode::kUsage);
  }
  return prepare.parsed() ? run_prepare_child(child) : run_serve(serve_flags);
}

}  // namespace
}  // namespace radfarm

int main(int argc, char** argv) { return radfarm::run(argc, argv); }
