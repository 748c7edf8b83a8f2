#include "cli/commands.h"

#include <string>
#include <vector>

namespace radfarm::cli {
namespace {

constexpr const char* kProgram = "radfarm";

/// CLI11's words, but a first word that is no verb is named.
std::string explain_parse_error(const CLI::App& app, int argc, const char* const* argv, const CLI::ParseError& error) {
  const std::vector<const CLI::App*> verbs =
      argc < 2 ? std::vector<const CLI::App*>()
               : app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == argv[1]; });
  if (argc < 2 || argv[1][0] == '-' || !verbs.empty()) return error.what();
  return std::string("'") + argv[1] + "' is not a command";
}

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
  for (const auto add :
       {add_render, add_bake, add_measure, add_explain, add_info, add_compare, add_ladder, add_doctor, add_submit, add_jobs, add_programs}) {
    add(app, action);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ConversionError& error) {
    return static_cast<int>(usage_error({Code::kInvalidArgument, std::string(error.what()) + ", must be a number"}));
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(usage_error({Code::kInvalidArgument, explain_parse_error(app, argc, argv, error)}));
  }
  const Result<ExitCode> done = action();
  return static_cast<int>(done ? *done : report_error(kProgram, done.error()));
}

}  // namespace radfarm::cli
