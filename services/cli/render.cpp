// `radfarm render`: a farm of its own on loopback, one job, the same code and the same bits as on a thousand machines.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "cli/closing_table.h"
#include "cli/commands.h"
#include "cli/deliver.h"
#include "cli/render_job.h"
#include "cli/request_flags.h"
#include "process/signals.h"

namespace radfarm::cli {
namespace {

struct RenderFlags {
  std::filesystem::path scene;
  Outputs outputs;
  RequestFlags request;
  int workers = 2;
  int threads = 0;  // 0: the machine's cores shared out
  bool no_cache = false;
};

Result<RenderedJob> render(const RenderFlags& flags, const RenderRequest& request, Events& events) {
  const SignalWatcher signals({SIGINT, SIGTERM, SIGCHLD}, [&](int signal) {
    if (signal == SIGCHLD) return events.child_ended();
    events.interrupt();
  });
  RADFARM_TRY_STATUS(check_folders(flags.outputs));
  RADFARM_TRY(LocalFarm farm, LocalFarm::start(local_farm_options(flags.workers, flags.threads, flags.no_cache)));
  return render_job(farm, flags.scene, request, flags.outputs, events);
}

Result<ExitCode> run_render(const RenderFlags& flags) {
  const Result<RenderRequest> request = parse_request(flags.request);
  if (!request) return usage_error(request.error());
  if (const Status usage = check_usage(flags.outputs, *request); !usage) return usage_error(usage.error());
  // The farm's own chatter is for whoever debugs it: RADFARM_LOG=info shows it.
  ::setenv("RADFARM_LOG", "warn", /*overwrite=*/0);
  Events events;
  RADFARM_TRY(const RenderedJob rendered, render(flags, *request, events));
  std::fputs(closing_table(rendered.report).c_str(), stdout);
  return exit_code_of(rendered.job);
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("render", "render a scene on this machine");
  const auto flags = std::make_shared<RenderFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  add_output_flags(verb, flags->outputs);
  add_request_flags(verb, flags->request);
  verb.add_option("--workers", flags->workers, "worker processes")->check(CLI::Range(1, 256));
  verb.add_option("--threads", flags->threads, "of each worker; default: the cores shared out")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--no-cache", flags->no_cache, "neither use nor keep solved light in ~/.cache/radfarm");
  verb.callback([&action, flags] { action = [flags] { return run_render(*flags); }; });
}

}  // namespace radfarm::cli
