// `radfarm submit`: a job on a farm that runs elsewhere.
#include <csignal>
#include <cstdio>
#include <memory>

#include "cli/closing_table.h"
#include "cli/commands.h"
#include "cli/deliver.h"
#include "cli/follow.h"
#include "cli/request_flags.h"
#include "cli/upload.h"
#include "process/signals.h"
#include "rpc/channel.h"

namespace radfarm::cli {
namespace {

struct SubmitFlags {
  std::filesystem::path scene;
  Outputs outputs;
  RequestFlags request;
  std::string server;
  bool wait = false;
};

Result<ExitCode> submit(const SubmitFlags& flags, const RenderRequest& request) {
  Events events;
  const SignalWatcher signals({SIGINT, SIGTERM}, [&](int) { events.interrupt(); });
  if (flags.wait) RADFARM_TRY_STATUS(check_folders(flags.outputs));
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, submit_scene(client, flags.scene, request, radfarm::Progress({}, events.interruption())));
  std::printf("%s\n", job.id.c_str());
  std::fflush(stdout);
  if (!flags.wait) return ExitCode::kDone;
  Progress progress(Progress::style_for_stderr());
  const Result<JobStatus> done = follow(client, job.id, {}, events, progress);
  progress.finish();
  if (!done) return tl::unexpected(done.error());
  RADFARM_TRY_STATUS(check_succeeded(*done));
  RADFARM_TRY(const nlohmann::json report, deliver(client, *done, flags.outputs, radfarm::Progress({}, events.interruption())));
  std::fputs(closing_table(report).c_str(), stdout);
  return exit_code_of(*done);
}

Result<ExitCode> run_submit(const SubmitFlags& flags) {
  const Result<RenderRequest> request = parse_request(flags.request);
  if (!request) return usage_error(request.error());
  if (const Status usage = check_usage(flags.outputs, *request); !usage) return usage_error(usage.error());
  if (const Status address = rpc::check_address(flags.server, "--server"); !address)
    return usage_error(address.error());
  return submit(flags, *request);
}

}  // namespace

void add_submit(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("submit", "render a scene on a farm; prints the job's id");
  const auto flags = std::make_shared<SubmitFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  add_output_flags(verb, flags->outputs);
  add_request_flags(verb, flags->request);
  verb.add_option("--server", flags->server, "HOST:PORT of a coordinator's client port")->required();
  verb.add_flag("--wait", flags->wait, "follow the job and write the outputs; Ctrl-C leaves the job running");
  verb.callback([&action, flags] { action = [flags] { return run_submit(*flags); }; });
}

}  // namespace radfarm::cli
