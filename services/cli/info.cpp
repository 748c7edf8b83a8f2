// `radfarm info`: what is in a scene file.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "pipeline/pipeline.h"
#include "process/end_on_signal.h"

namespace radfarm::cli {
namespace {

struct InfoFlags {
  std::filesystem::path scene;
  bool json = false;
};

Result<ExitCode> run_info(const InfoFlags& flags) {
  const EndOnSignal interrupted("radfarm");
  RADFARM_TRY(const nlohmann::json scene, describe_scene(flags.scene));
  if (flags.json) {
    std::printf("%s\n", scene.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return ExitCode::kDone;
  }
  for (const auto& [name, value] : scene.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%-24s %s\n", name.c_str(), text.c_str());
  }
  return ExitCode::kDone;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("info", "what is in a scene file");
  const auto flags = std::make_shared<InfoFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  verb.add_flag("--json", flags->json, "for programs");
  verb.callback([&action, flags] { action = [flags] { return run_info(*flags); }; });
}

}  // namespace radfarm::cli
