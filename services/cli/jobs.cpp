// `radfarm jobs list|get|wait|fetch|cancel|extend|estimate`: the jobs of a farm that runs elsewhere.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/deliver.h"
#include "cli/follow.h"
#include "cli/request_flags.h"
#include "process/end_on_signal.h"
#include "process/signals.h"
#include "rpc/channel.h"

namespace radfarm::cli {
namespace {

struct JobsFlags {
  std::string server, id, error;
  bool json = false;
  double timeout_seconds = 0;  // 0: none
  Outputs outputs;
};

nlohmann::json to_json(const JobStatus& job) {
  const JobProgress& p = job.progress;
  nlohmann::json json = {{"id", job.id},
                         {"display_name", job.display_name},
                         {"state", to_string(job.state)},
                         {"created_unix_seconds", job.created_unix_seconds},
                         {"progress",
                          {{"tasks_total", p.tasks_total},
                           {"tasks_committed", p.tasks_committed},
                           {"tasks_leased", p.tasks_leased},
                           {"attempts_failed", p.attempts_failed},
                           {"attempts_expired", p.attempts_expired},
                           {"results_diverged", p.results_diverged},
                           {"waiting_for", p.waiting_for},
                           {"round", p.round},
                           {"phase", p.phase.name},
                           {"phase_done", p.phase.done},
                           {"phase_total", p.phase.total}}},
                         {"target_missed", job.target_missed},
                         {"cpu_s", job.cpu_seconds},
                         {"estimates", nlohmann::json::array()},
                         {"artifacts", nlohmann::json::array()}};
  for (const CostEstimate& e : job.estimates) {
    json["estimates"].push_back({{"ask", e.ask}, {"cpu_s", {e.cpu_low_seconds, e.cpu_high_seconds}}});
  }
  if (job.state == JobState::kFailed) {
    json["failure"] = {{"reason", to_string(job.failure.reason)}, {"message", job.failure.error.message}};
  }
  for (const Artifact& artifact : job.artifacts) {
    json["artifacts"].push_back(
        {{"name", artifact.name}, {"digest", artifact.blob.digest}, {"size", artifact.blob.size}});
  }
  return json;
}

void print_line(const JobStatus& job) {
  std::printf("%s  %-10s  %u/%u  %s%s%s\n", job.id.c_str(), to_string(job.state).c_str(), job.progress.tasks_committed,
              job.progress.tasks_total, job.display_name.c_str(), job.state == JobState::kFailed ? "  " : "",
              job.failure.error.message.c_str());
}

void print_json(const nlohmann::json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

Result<ExitCode> list(const JobsFlags& flags) {
  const EndOnSignal interrupted("radfarm");
  FarmClient client(flags.server);
  RADFARM_TRY(const std::vector<JobStatus> jobs, client.list());
  nlohmann::json array = nlohmann::json::array();
  for (const JobStatus& job : jobs) {
    if (flags.json)
      array.push_back(to_json(job));
    else
      print_line(job);
  }
  if (flags.json) print_json(array);
  return ExitCode::kDone;
}

Result<ExitCode> show(const JobsFlags& flags, const JobStatus& job) {
  if (flags.json)
    print_json(to_json(job));
  else
    print_line(job);
  return ExitCode::kDone;
}

Result<ExitCode> get(const JobsFlags& flags) {
  const EndOnSignal interrupted("radfarm");
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, client.get(flags.id));
  return show(flags, job);
}

Result<ExitCode> cancel(const JobsFlags& flags) {
  const EndOnSignal interrupted("radfarm");
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, client.cancel(flags.id));
  return show(flags, job);
}

Result<ExitCode> wait(const JobsFlags& flags) {
  Events events;
  const SignalWatcher signals({SIGINT, SIGTERM}, [&](int) { events.interrupt(); });
  FarmClient client(flags.server);
  FollowOptions options;
  if (flags.timeout_seconds > 0) {
    const std::chrono::milliseconds limit(static_cast<long long>(1000 * flags.timeout_seconds));
    options.deadline = std::chrono::steady_clock::now() + limit;
  }
  Progress progress(Progress::style_for_stderr());
  const Result<JobStatus> done = follow(client, flags.id, options, events, progress);
  progress.finish();
  if (!done) return tl::unexpected(done.error());
  RADFARM_TRY_STATUS(check_succeeded(*done));
  RADFARM_TRY([[maybe_unused]] const ExitCode shown, show(flags, *done));
  return exit_code_of(*done);
}

Result<ExitCode> extend(const JobsFlags& flags) {
  const Result<double> error = parse_error_target(flags.error);
  if (!error) return usage_error(error.error());
  const EndOnSignal interrupted("radfarm");
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, client.extend(flags.id, *error));
  return show(flags, job);
}

Result<ExitCode> estimate(const JobsFlags& flags) {
  const EndOnSignal interrupted("radfarm");
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, client.get(flags.id));
  if (job.estimates.empty()) {
    return fail(Code::kFailedPrecondition,
                "job " + job.id + " is " + to_string(job.state) + " and has not been prepared yet; ask again");
  }
  if (flags.json) return show(flags, job);
  for (const CostEstimate& e : job.estimates) {
    std::printf("%-10s %10.1f to %.1f CPU s expected\n", e.ask.c_str(), e.cpu_low_seconds, e.cpu_high_seconds);
  }
  std::printf("%-10s %10.1f CPU s of tasks so far\n", "", job.cpu_seconds);
  return ExitCode::kDone;
}

Result<ExitCode> fetch(const JobsFlags& flags) {
  if (const Status usage = check_usage(flags.outputs); !usage) return usage_error(usage.error());
  RADFARM_TRY_STATUS(check_folders(flags.outputs));
  Events events;
  const SignalWatcher signals({SIGINT, SIGTERM}, [&](int) { events.interrupt(); });
  FarmClient client(flags.server);
  RADFARM_TRY(const JobStatus job, client.get(flags.id));
  if (!is_terminal(job.state)) {
    return fail(Code::kFailedPrecondition,
                "job " + job.id + " is " + to_string(job.state) + "; see `radfarm jobs wait`");
  }
  RADFARM_TRY_STATUS(check_succeeded(job));
  const radfarm::Progress progress({}, events.interruption());
  RADFARM_TRY([[maybe_unused]] const nlohmann::json report, deliver(client, job, flags.outputs, progress));
  return exit_code_of(job);
}

using JobVerb = Result<ExitCode> (*)(const JobsFlags&);

CLI::App& add_verb(CLI::App& jobs, Action& action, const std::shared_ptr<JobsFlags>& flags, const char* name,
                   const char* help, JobVerb run) {
  CLI::App& verb = *jobs.add_subcommand(name, help);
  verb.add_option("--server", flags->server, "HOST:PORT of the coordinator's client port")->required();
  verb.callback([&action, flags, run] {
    action = [flags, run]() -> Result<ExitCode> {
      const Status address = rpc::check_address(flags->server, "--server");
      return address ? run(*flags) : usage_error(address.error());
    };
  });
  return verb;
}

}  // namespace

void add_jobs(CLI::App& app, Action& action) {
  CLI::App& jobs = *app.add_subcommand("jobs", "the jobs of a farm");
  jobs.require_subcommand(1);
  const auto flags = std::make_shared<JobsFlags>();  // shared: by the parser and by the action
  add_verb(jobs, action, flags, "list", "all jobs, oldest first", list).add_flag("--json", flags->json, "for programs");
  CLI::App& get_verb = add_verb(jobs, action, flags, "get", "one job as it stands", get);
  CLI::App& wait_verb = add_verb(jobs, action, flags, "wait", "wait until a job is over", wait);
  CLI::App& fetch_verb = add_verb(jobs, action, flags, "fetch", "write a finished job's image", fetch);
  CLI::App& cancel_verb = add_verb(jobs, action, flags, "cancel", "end a job", cancel);
  CLI::App& extend_verb = add_verb(jobs, action, flags, "extend", "a finished job goes on, for a smaller error", extend);
  CLI::App& estimate_verb =
      add_verb(jobs, action, flags, "estimate", "the CPU time that a job, and others of its view, may take", estimate);
  extend_verb.add_option("--error", flags->error, "the relative error to be below, such as 1%")->required();
  for (CLI::App* verb : {&get_verb, &wait_verb, &fetch_verb, &cancel_verb, &extend_verb, &estimate_verb}) {
    verb->add_option("JOB", flags->id, "the id that submit printed")->required();
  }
  for (CLI::App* verb : {&get_verb, &wait_verb, &cancel_verb, &extend_verb, &estimate_verb}) {
    verb->add_flag("--json", flags->json, "for programs");
  }
  wait_verb.add_option("--timeout", flags->timeout_seconds, "seconds, then exit code 6")->check(CLI::Range(0.0, 1e9));
  add_output_flags(fetch_verb, flags->outputs);
}

}  // namespace radfarm::cli
