#include "cli/commands.h"

#include <string>

namespace radfarm::cli {
namespace {

constexpr const char* kProgram = "radfarm";

}  // namespace

ExitCode usage_error(const Error& error) {
  report_error(kProgram, {error.code, error.message + "; see --help"});
  return ExitCode::kUsage;
}

int run(int argc, const char* const* argv) {
  CLI::App app("renders scenes with physically based light, here or on a farm", kProgram);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("radfarm ") + RADFARM_VERSION);
  Action action;
  for (const auto add : {add_render, add_explain, add_info, add_compare, add_doctor, add_submit, add_jobs, add_programs}) {
    add(app, action);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(usage_error({Code::kInvalidArgument, error.what()}));
  }
  const Result<ExitCode> done = action();
  return static_cast<int>(done ? *done : report_error(kProgram, done.error()));
}

}  // namespace radfarm::cli
