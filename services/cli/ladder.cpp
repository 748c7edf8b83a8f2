// `radfarm ladder`: what accuracy costs in time. Settings x integrators against a reference in two halves.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "base/file.h"
#include "cli/commands.h"
#include "cli/ladder_page.h"
#include "cli/ladder_pictures.h"
#include "cli/ladder_rungs.h"
#include "cli/render_job.h"
#include "cli/request_flags.h"
#include "image/exr.h"
#include "image/flip.h"
#include "image/png.h"
#include "image/tone_map.h"
#include "process/signals.h"
#include "rpc/limits.h"
#include "scene/scene_files.h"

namespace radfarm::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPictureWidth = 320;
constexpr double kMostDifference = 0.2;
constexpr std::size_t kMostReportBytes = std::size_t{1} << 26;

struct LadderFlags {
  fs::path scene, folder;
  std::vector<fs::path> reference;  // one or two files; empty: rendered
  std::string integrators = "gather,path-trace,paths", qualities = "preview,standard,high";
  int reference_samples = 1024;
  RequestFlags request;
  int workers = 2, threads = 0;
};

Result<Image> read_exr(const fs::path& path) {
  RADFARM_TRY(const std::string bytes, read_file(path, limits::kBlobBytes));
  Result<Image> image = decode_exr(std::as_bytes(std::span(bytes)));
  if (!image) return annotate(image.error(), path.string());
  return image;
}

/// Of all files of the scene: what a folder's results belong to.
Result<std::string> digest_of_scene(const fs::path& scene) {
  RADFARM_TRY(const std::vector<fs::path> files, scene_files(scene));
  Sha256 hash;
  for (const fs::path& file : files) {
    const Result<MappedFile> mapped = MappedFile::open(scene.parent_path() / file);
    if (!mapped) return annotate(mapped.error(), file.string());
    hash.update(mapped->bytes());
  }
  return hash.hex();
}

/// A ladder under way: its folder and the farm, started when something is to be rendered. Solved light is not used again: each
/// rung pays for its own.
class Climb {
 public:
  Climb(const LadderFlags& flags, std::string scene_digest, Events& events)
      : flags_(flags), scene_digest_(std::move(scene_digest)), events_(events) {}

  /// The report of a request's image, FOLDER/NAME.exr: rendered, unless that was done before for the same scene and request.
  Result<json> obtain(const std::string& name, RenderRequest request) {
    const Outputs outputs{flags_.folder / (name + ".exr"), {}, flags_.folder / (name + ".json")};
    const json key = key_of(request);
    if (std::optional<json> known = find(outputs, key)) {
      std::fprintf(stderr, "%s: done before\n", name.c_str());
      return std::move(*known);
    }
    std::fprintf(stderr, "%s\n", name.c_str());
    if (!farm_) {
      RADFARM_TRY(LocalFarm started, LocalFarm::start(local_farm_options(flags_.workers, flags_.threads, /*no_cache=*/true)));
      farm_ = std::make_unique<LocalFarm>(std::move(started));
    }
    RADFARM_TRY(RenderedJob rendered, render_job(*farm_, flags_.scene, request, outputs, events_));
    rendered.report["ladder_key"] = key;
    RADFARM_TRY_STATUS(write_file_atomically(outputs.report, rendered.report.dump(2, ' ', false, json::error_handler_t::replace) + "\n"));
    return std::move(rendered.report);
  }

 private:
  json key_of(RenderRequest request) const {
    (void)attach_files(request);
    return {{"scene", scene_digest_}, {"request", to_json(request)}, {"version", RADFARM_VERSION}};
  }

  static std::optional<json> find(const Outputs& outputs, const json& key) {
    std::error_code ignored;
    if (!fs::exists(outputs.exr, ignored)) return std::nullopt;
    const Result<std::string> text = read_file(outputs.report, kMostReportBytes);
    if (!text) return std::nullopt;
    json report = json::parse(*text, nullptr, /*allow_exceptions=*/false);
    if (!report.is_object() || report.value("ladder_key", json()) != key) return std::nullopt;
    return report;
  }

  const LadderFlags& flags_;
  const std::string scene_digest_;
  Events& events_;
  std::unique_ptr<LocalFarm> farm_;
};

struct Reference {
  Image a, b, mean;
};

Result<Reference> obtain_reference(const LadderFlags& flags, const RenderRequest& base, Climb& climb) {
  fs::path files[2];
  for (int half = 0; half < 2; ++half) {
    if (!flags.reference.empty()) {
      files[half] = flags.reference[flags.reference.size() == 1 ? 0 : static_cast<std::size_t>(half)];
      continue;
    }
    const std::string name = half == 0 ? "reference-a" : "reference-b";
    RADFARM_TRY(const json report, climb.obtain(name, reference_half(base, flags.reference_samples, half)));
    files[half] = flags.folder / (name + ".exr");
  }
  Reference reference;
  RADFARM_TRY(reference.a, read_exr(files[0]));
  RADFARM_TRY(reference.b, read_exr(files[1]));
  // Checks that both have the same size and channels.
  if (const auto checked = reference_error(reference.a, reference.a, reference.b); !checked) return tl::unexpected(checked.error());
  reference.mean = mean_of(reference.a, reference.b);
  return reference;
}

Result<LadderRow> measure(const Rung& rung, const json& report, const Image& image, const Reference& reference) {
  LadderRow row;
  row.name = rung.name, row.curve = rung.curve;
  row.cpu_s = stage_seconds(report, "cpu_s"), row.wall_s = stage_seconds(report, "wall_s");
  row.counts = report.value("counts", json::object());
  RADFARM_TRY(row.error, reference_error(image, reference.a, reference.b));
  RADFARM_TRY(const FlipMap seen, flip(image, reference.mean, auto_exposure(reference.mean)));
  row.flip = seen.mean;
  return row;
}

Result<RowPictures> picture(const Image& image, const Reference& reference) {
  const Image small = shrunk(image, kPictureWidth);
  RowPictures pictures;
  RADFARM_TRY(pictures.image, encode_png(small, auto_exposure(reference.mean)));
  RADFARM_TRY(pictures.difference, difference_picture(small, shrunk(reference.mean, kPictureWidth), kMostDifference));
  return pictures;
}

Status write_results(const LadderFlags& flags, const LadderPage& page) {
  nlohmann::ordered_json all = {{"scene", page.title}, {"command", page.command}, {"reference_relative_error", page.reference_relative},
                                {"rungs", to_json(page.rows)}};
  RADFARM_TRY_STATUS(write_file_atomically(flags.folder / "ladder.csv", to_csv(page.rows)));
  RADFARM_TRY_STATUS(write_file_atomically(flags.folder / "ladder.json", all.dump(2) + "\n"));
  return write_file_atomically(flags.folder / "ladder.html", ladder_page(page));
}

void print(const LadderRow& row) {
  std::printf("%-24s %9.2f CPU s  %8.3g %%  (%.3g to %.3g)  FLIP %.4f\n", row.name.c_str(), row.cpu_s, 100 * row.error.relative,
              100 * row.error.relative_low, 100 * row.error.relative_high, row.flip);
}

Status climb_all(const LadderFlags& flags, const RenderRequest& base, const std::vector<Rung>& rungs, Events& events) {
  const SignalWatcher signals({SIGINT, SIGTERM, SIGCHLD}, [&](int signal) {
    if (signal == SIGCHLD) return events.child_ended();
    events.interrupt();
  });
  RADFARM_TRY(const std::string digest, digest_of_scene(flags.scene));
  Climb climb(flags, digest, events);
  RADFARM_TRY(const Reference reference, obtain_reference(flags, base, climb));
  LadderPage page;
  page.title = flags.scene.filename().string();
  page.command = "radfarm ladder " + page.title + " -o DIR --integrators " + flags.integrators + " --qualities " + flags.qualities +
                 " --reference-samples " + std::to_string(flags.reference_samples);
  page.most_difference = kMostDifference;
  RADFARM_TRY(page.reference, encode_png(shrunk(reference.mean, kPictureWidth), auto_exposure(reference.mean)));
  for (const Rung& rung : rungs) {
    std::fprintf(stderr, "rung %zu of %zu: ", page.rows.size() + 1, rungs.size());
    RADFARM_TRY(const json report, climb.obtain(rung.name, rung.request));
    RADFARM_TRY(const Image image, read_exr(flags.folder / (rung.name + ".exr")));
    RADFARM_TRY(LadderRow row, measure(rung, report, image, reference));
    RADFARM_TRY(RowPictures pictures, picture(image, reference));
    print(row);
    page.reference_relative = row.error.reference_relative;
    page.rows.push_back(std::move(row));
    page.pictures.push_back(std::move(pictures));
    mark_best(page.rows);
    // After each rung: who stops it half-way has what is done.
    RADFARM_TRY_STATUS(write_results(flags, page));
  }
  return {};
}

Status check_flags(const LadderFlags& flags) {
  if (flags.reference.size() > 2) return fail(Code::kInvalidArgument, "--reference: one file, or two independent halves");
  if (flags.reference_samples < 2) return fail(Code::kInvalidArgument, "--reference-samples must be at least 2");
  std::error_code error;
  fs::create_directories(flags.folder, error);
  if (error) return fail(Code::kPermissionDenied, flags.folder.string() + ": cannot be created: " + error.message());
  return {};
}

Result<ExitCode> run_ladder(const LadderFlags& flags) {
  const Result<RenderRequest> base = parse_request(flags.request);
  if (!base) return usage_error(base.error());
  const Result<std::vector<Rung>> rungs = make_rungs(*base, flags.integrators, flags.qualities);
  if (!rungs) return usage_error(rungs.error());
  if (const Status usage = check_flags(flags); !usage) return usage_error(usage.error());
  ::setenv("RADFARM_LOG", "warn", /*overwrite=*/0);
  Events events;
  RADFARM_TRY_STATUS(climb_all(flags, *base, *rungs, events));
  std::printf("%s\n", (flags.folder / "ladder.html").c_str());
  return ExitCode::kDone;
}

}  // namespace

void add_ladder(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("ladder", "what accuracy costs: settings x integrators, error against time");
  const auto flags = std::make_shared<LadderFlags>();  // shared: by the parser and by the action
  verb.add_option("SCENE", flags->scene, ".gltf, .glb or .obj")->required();
  verb.add_option("-o,--output", flags->folder, "DIR: ladder.csv, ladder.json, ladder.html and the images; a ladder that was stopped goes on")
      ->required();
  verb.add_option("--integrators", flags->integrators, "separated by commas");
  verb.add_option("--qualities", flags->qualities, "separated by commas");
  verb.add_option("--reference", flags->reference, "R.exr, or its two independent halves; default: path-traced into DIR");
  verb.add_option("--reference-samples", flags->reference_samples, "paths a pixel of each half");
  add_request_flags(verb, flags->request);
  verb.add_option("--workers", flags->workers, "worker processes")->check(CLI::Range(1, 256));
  verb.add_option("--threads", flags->threads, "of each worker; default: the cores shared out")->check(CLI::Range(1, 1024));
  verb.callback([&action, flags] { action = [flags] { return run_ladder(*flags); }; });
}

}  // namespace radfarm::cli
