// `radfarm measure`: light meters in a scene, and work planes of them. Runs in this process.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/deliver.h"
#include "cli/phase_display.h"
#include "cli/request_flags.h"
#include "meters/meter_file.h"
#include "pipeline/measure_light.h"
#include "process/end_on_signal.h"

namespace radfarm::cli {
namespace {

using nlohmann::json;

constexpr std::size_t kMostCsvBytes = std::size_t{1} << 30;

struct MeasureFlags {
  std::filesystem::path scene, output, points, png;
  std::optional<float> height, spacing, floor;
  std::string method = "gather", up = "Y", error;
  std::optional<std::int64_t> samples, photons;
  std::optional<float> radius;
  std::string env;
  std::vector<std::string> ies;
  std::uint64_t seed = 1;
  bool as_json = false;
};

tl::unexpected<Error> refuse(const std::string& what) { return fail(Code::kInvalidArgument, what); }

bool is_positive(const std::optional<float>& value) { return !value || (std::isfinite(*value) && *value > 0); }

Status check_flags(const MeasureFlags& flags) {
  const bool has_plane = flags.height || flags.spacing || flags.floor;
  if (flags.points.empty() != has_plane)
    return refuse("needs --points P.csv, or --height H --spacing S of a work plane");
  if (!flags.png.empty() && !has_plane) return refuse("--png shows a work plane: give --height and --spacing");
  if (!is_positive(flags.spacing)) return refuse("--spacing must be above 0 m");
  if (flags.height && !(std::isfinite(*flags.height) && *flags.height >= 0))
    return refuse("--height must be at least 0 m");
  if (flags.method != "gather" && flags.method != "paths")
    return refuse("--method '" + flags.method + "' is unknown; gather or paths");
  const bool is_paths = flags.method == "paths";
  if (is_paths && (flags.samples || !flags.error.empty()))
    return refuse("--samples and --error are of --method gather; --photons N is of paths");
  if (!is_paths && (flags.photons || flags.radius))
    return refuse("--photons and --radius are of --method paths; --error and --samples are of gather");
  if (flags.samples && *flags.samples < 1) return refuse("--samples must be at least 1");
  if (flags.photons && *flags.photons < 1) return refuse("--photons must be at least 1");
  if (!is_positive(flags.radius)) return refuse("--radius must be above 0 m");
  return {};
}

/// "2%" or "2": .02.
Result<double> parse_percent(const std::string& text) {
  const std::string number = text.ends_with('%') ? text.substr(0, text.size() - 1) : text;
  char* end = nullptr;
  const double percent = std::strtod(number.c_str(), &end);
  if (number.empty() || end != number.c_str() + number.size() || !(percent > 0) || percent > 100) {
    return refuse("--error '" + text + "' must be a percentage above 0, such as 2%");
  }
  return percent / 100;
}

Result<MeasureRequest> make_request(const MeasureFlags& flags) {
  RADFARM_TRY_STATUS(check_flags(flags));
  RequestFlags shared;
  shared.up = flags.up, shared.env = flags.env, shared.ies = flags.ies;
  RADFARM_TRY(RenderRequest like, parse_request(shared));
  locate_files(like);
  MeasureRequest request;
  request.load.up = like.up == RenderRequest::UpAxis::kZ ? LoadOptions::UpAxis::kZ : LoadOptions::UpAxis::kY;
  request.env = like.env, request.ies = like.ies, request.seed = flags.seed;
  request.method = flags.method == "paths" ? MeasureRequest::Method::kPaths : MeasureRequest::Method::kGather;
  if (!flags.error.empty()) {
    RADFARM_TRY(request.error, parse_percent(flags.error));
  }
  request.samples = static_cast<std::uint64_t>(flags.samples.value_or(0));
  if (flags.photons) request.photons = static_cast<std::uint64_t>(*flags.photons);
  request.radius = flags.radius.value_or(0);
  request.plane.height = flags.height.value_or(request.plane.height);
  request.plane.spacing = flags.spacing.value_or(request.plane.spacing);
  request.plane.floor = flags.floor;
  request.picture = !flags.png.empty();
  return request;
}

Result<MeasuredLight> measure_or_end(const MeasureFlags& flags, const MeasureRequest& request) {
  const EndOnSignal interrupted("radfarm");
  PhaseDisplay display(Progress::style_for_stderr(), JobState::kRendering);
  return measure_light(flags.scene, request, display.progress());
}

json summary_json(const MeasuredLight& light, const MeasureFlags& flags, double seconds) {
  const Summary& s = light.summary;
  json summary = {{"method", flags.method},
                  {"points", s.points},
                  {"least_lux", s.least},
                  {"mean_lux", s.mean},
                  {"most_lux", s.most},
                  {"uniformity", s.uniformity},
                  {"least_over_most", s.diversity},
                  {"widest_relative_half_width", s.widest},
                  {"seed", flags.seed},
                  {"cpu_s", seconds},
                  {"notes", light.notes}};
  if (light.floor) summary["floor"] = *light.floor;
  if (!light.levels.empty()) summary["contour_lux"] = light.levels;
  return summary;
}

void print_summary(const MeasuredLight& light, const MeasureFlags& flags, double seconds) {
  const Summary& s = light.summary;
  std::printf("%s: %zu points", flags.output.c_str(), s.points);
  if (light.floor) std::printf(", floor at %.3g m", static_cast<double>(*light.floor));
  std::printf(
      "\n  illuminance  least %.4g lx, mean %.4g lx, most %.4g lx\n  uniformity   %.2f (least / mean), %.2f (least / "
      "most)\n"
      "  95 %% interval at most +-%.2g %% of a reading, by %s, %.1f CPU s\n",
      s.least, s.mean, s.most, s.uniformity, s.diversity, 100 * s.widest, flags.method.c_str(), seconds);
  if (!flags.png.empty() && !light.levels.empty()) {
    std::printf("  %s: lines at", flags.png.c_str());
    for (const double level : light.levels) std::printf(" %g", level);
    std::printf(" lx\n");
  }
  for (const std::string& note : light.notes) std::printf("  note: %s\n", note.c_str());
}

Result<ExitCode> run_measure(const MeasureFlags& flags) {
  Result<MeasureRequest> request = make_request(flags);
  if (!request) return usage_error(request.error());
  RADFARM_TRY_STATUS(check_folder(flags.output));
  if (!flags.png.empty()) RADFARM_TRY_STATUS(check_folder(flags.png));
  if (!flags.points.empty()) {
    RADFARM_TRY(request->points, read_file(flags.points, kMostCsvBytes));
  }
  const Stopwatch watch;
  const Result<MeasuredLight> light = measure_or_end(flags, *request);
  if (!light) return tl::unexpected(light.error());
  const std::string csv = write_readings(light->meters, light->readings, light->origin);
  RADFARM_TRY_STATUS(write_file_atomically(flags.output, std::as_bytes(std::span(csv))));
  if (!flags.png.empty()) RADFARM_TRY_STATUS(write_file_atomically(flags.png, light->png));
  if (flags.as_json) {
    std::printf("%s\n", summary_json(*light, flags, watch.cpu_seconds()).dump(2).c_str());
  } else {
    print_summary(*light, flags, watch.cpu_seconds());
  }
  return ExitCode::kDone;
}

}  // namespace

void add_measure(CLI::App& app, Action& action) {
  CLI::App& verb =
      *app.add_subcommand("measure", "illuminance in lux at points or over a work plane, with 95 % intervals");
  const auto flags = std::make_shared<MeasureFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  verb.add_option("-o,--output", flags->output, "LUX.csv: x,y,z,nx,ny,nz,lux,lux_low,lux_high,red,green,blue,samples")
      ->required();
  verb.add_option("--points", flags->points,
                  "P.csv: a line each of x,y,z or x,y,z,nx,ny,nz in metres, as in the scene file");
  verb.add_option("--height", flags->height, "of a work plane above the floor, m (0.85)");
  verb.add_option("--spacing", flags->spacing, "of the plane's points, m (0.25)");
  verb.add_option("--floor", flags->floor, "height of the floor in the scene file, m; default: found");
  verb.add_option("--png", flags->png, "OUT.png: the work plane in false colours with contour lines");
  verb.add_option("--method", flags->method,
                  "gather: unbiased paths from each point; paths: photon paths from the lights, caustics too");
  verb.add_option("--error", flags->error, "P%: half width of the 95 % interval aimed at, of gather; default 2%");
  verb.add_option("--samples", flags->samples, "paths a point, of gather; default: by --error");
  verb.add_option("--photons", flags->photons, "light paths, of paths; default 4000000");
  verb.add_option("--radius", flags->radius, "m, of the discs of paths; default: by how many paths cross");
  verb.add_option("--seed", flags->seed, "another seed, other random numbers");
  verb.add_option("--up", flags->up, "Y or Z: which axis of an OBJ file points up");
  verb.add_option("--env", flags->env, "MAP.hdr, MAP.exr or sky:KEY=VALUE,...: light from all around; docs/sky.md");
  verb.add_option("--ies", flags->ies, "NAME=FILE: a light of the scene shines as an IES file says; may be repeated");
  verb.add_flag("--json", flags->as_json, "print the summary as JSON");
  verb.callback([&action, flags] { action = [flags] { return run_measure(*flags); }; });
}

}  // namespace radfarm::cli
