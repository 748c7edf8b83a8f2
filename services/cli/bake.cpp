// `radfarm bake`: the radiosity solution as a glTF file that any viewer shows, for walk-throughs. Runs in this process.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/deliver.h"
#include "cli/phase_display.h"
#include "cli/request_flags.h"
#include "cli/solution_folder.h"
#include "pipeline/pipeline.h"
#include "process/end_on_signal.h"

namespace radfarm::cli {
namespace {

struct BakeFlags {
  std::filesystem::path scene, output;
  std::string exposure = "auto";
  bool no_cache = false;
  RequestFlags request;
};

/// Until there is something to write, a signal ends the process.
Result<Baked> bake_or_end(const std::filesystem::path& scene, const RenderRequest& request,
                          const std::optional<float>& exposure_ev, const SolutionStore& store) {
  const EndOnSignal interrupted("radfarm");
  PhaseDisplay display(Progress::style_for_stderr(), JobState::kPreparing);
  return bake(scene, request, exposure_ev, {store, display.progress()});
}

Result<ExitCode> run_bake(const BakeFlags& flags) {
  Result<RenderRequest> request = parse_request(flags.request);
  if (!request) return usage_error(request.error());
  if (flags.output.extension() != ".glb") {
    return usage_error({Code::kInvalidArgument, "-o: '" + flags.output.string() + "' must end in .glb"});
  }
  const Result<std::optional<float>> exposure = parse_exposure(flags.exposure);
  if (!exposure) return usage_error(exposure.error());
  RADFARM_TRY_STATUS(check_folder(flags.output));
  locate_files(*request);
  const SolutionStore store(flags.no_cache ? "" : solution_folder(), kSolutionBytes);
  RADFARM_TRY(const Baked baked, bake_or_end(flags.scene, *request, *exposure, store));
  RADFARM_TRY_STATUS(write_file_atomically(flags.output, baked.glb));
  std::printf("%s: %zu elements, %zu triangles, %.1f MB, exposure %+.2f EV\n", flags.output.c_str(), baked.elements,
              baked.triangles, static_cast<double>(baked.glb.size()) / 1e6, static_cast<double>(baked.exposure_ev));
  return ExitCode::kDone;
}

}  // namespace

void add_bake(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("bake", "write the radiosity solution as a glTF for walk-throughs");
  const auto flags = std::make_shared<BakeFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  verb.add_option("-o,--output", flags->output, "OUT.glb")->required();
  verb.add_option("--exposure", flags->exposure, "EV (stops) or auto: how bright the vertex colours are");
  verb.add_option("--quality", flags->request.quality, "preview, standard, high or reference");
  verb.add_option("--link-error", flags->request.link_error, "largest share of all light that one link may misplace; default from --quality");
  verb.add_option("--seed", flags->request.seed, "another seed, another independent solution");
  verb.add_option("--up", flags->request.up, "Y or Z: which axis of an OBJ file points up");
  verb.add_option("--effects", flags->request.effects, "+id,-id: force effects on or off; see `radfarm explain`");
  verb.add_option("--env", flags->request.env, "MAP.hdr, MAP.exr or sky:KEY=VALUE,...: light from all around; docs/sky.md");
  verb.add_option("--ies", flags->request.ies, "NAME=FILE: a light of the scene shines as an IES file says; may be repeated");
  verb.add_flag("--no-cache", flags->no_cache, "neither use nor keep solved light in ~/.cache/radfarm");
  flags->request.integrator = "radiosity";
  verb.callback([&action, flags] { action = [flags] { return run_bake(*flags); }; });
}

}  // namespace radfarm::cli
