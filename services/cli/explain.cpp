// `radfarm explain`: which effects a render would simulate, and why.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "cli/closing_table.h"
#include "cli/commands.h"
#include "cli/request_flags.h"
#include "pipeline/pipeline.h"
#include "process/end_on_signal.h"

namespace radfarm::cli {
namespace {

struct ExplainFlags {
  std::filesystem::path scene;
  RequestFlags request;
  bool json = false;
};

Result<ExitCode> run_explain(const ExplainFlags& flags) {
  Result<RenderRequest> request = parse_request(flags.request);
  if (!request) return usage_error(request.error());
  locate_files(*request);
  const EndOnSignal interrupted("radfarm");
  RADFARM_TRY(const nlohmann::json plan, explain(flags.scene, *request));
  if (flags.json) {
    std::printf("%s\n", plan.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return ExitCode::kDone;
  }
  std::fputs(effects_table(plan).c_str(), stdout);
  for (const nlohmann::json& warning : plan.value("warnings", nlohmann::json::array())) {
    if (warning.is_string()) std::printf("warning: %s\n", warning.get<std::string>().c_str());
  }
  return ExitCode::kDone;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("explain", "which effects a render would simulate, and why");
  const auto flags = std::make_shared<ExplainFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  verb.add_flag("--json", flags->json, "for programs");
  add_request_flags(verb, flags->request);
  verb.callback([&action, flags] { action = [flags] { return run_explain(*flags); }; });
}

}  // namespace radfarm::cli
