#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "base/status.h"
#include "process/exit_code.h"

namespace radfarm::cli {

/// What a command line asks for: set by the parser, run by main. An error becomes one line on stderr and its exit code.
using Action = std::function<Result<ExitCode>()>;

/// Each verb's file declares its flags on `app` and sets `action` when the verb is given.
void add_render(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_bake(CLI::App& app, Action& action);
void add_measure(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
/// `ladder`: what accuracy costs in time.
void add_ladder(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);
void add_submit(CLI::App& app, Action& action);
void add_jobs(CLI::App& app, Action& action);
/// `coordinator` and `worker`: the rest of the line goes to the program of that name.
void add_programs(CLI::App& app, Action& action);

/// The whole command line. Returns the exit code; prints help and errors.
int run(int argc, const char* const* argv);

/// Says what is wrong with the command line, and that help exists.
ExitCode usage_error(const Error& error);

}  // namespace radfarm::cli
