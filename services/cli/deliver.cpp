#include "cli/deliver.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <vector>

#include "base/file.h"
#include "cli/report_page.h"
#include "frame/aov_picture.h"
#include "frame/aovs.h"
#include "frame/light_layers.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/tone_map.h"
#include "rpc/limits.h"

namespace radfarm::cli {
namespace {

Result<std::vector<std::byte>> download(FarmClient& client, const JobStatus& job, const std::string& name,
                                        const radfarm::Progress& progress) {
  const auto found = std::find_if(job.artifacts.begin(), job.artifacts.end(),
                                  [&](const Artifact& artifact) { return artifact.name == name; });
  if (found == job.artifacts.end()) return fail(Code::kDataLoss, "job " + job.id + " left no " + name);
  return client.blobs().download(found->blob.digest, limits::kBlobBytes, progress);
}

/// Stops, as asked for or by the image.
Result<float> exposure_of(const Image& image, const Outputs& outputs) {
  RADFARM_TRY(const std::optional<float> exposure, parse_exposure(outputs.exposure));
  return exposure ? *exposure : auto_exposure(image);
}

Status write_png(std::span<const std::byte> exr, const Outputs& outputs) {
  RADFARM_TRY(const Image image, decode_exr(exr));
  RADFARM_TRY(const float exposure, exposure_of(image, outputs));
  RADFARM_TRY(const std::vector<std::byte> png, encode_png(image, exposure));
  return write_file_atomically(outputs.png, png);
}

Status write_report(const nlohmann::json& report, std::span<const std::byte> exr, const Outputs& outputs) {
  if (outputs.report.extension() == ".json") {
    return write_file_atomically(outputs.report, report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  RADFARM_TRY(const Image image, decode_exr(exr));
  RADFARM_TRY(const float exposure, exposure_of(image, outputs));
  RADFARM_TRY(const std::vector<std::byte> png, encode_png(image, exposure));
  return write_file_atomically(outputs.report, report_page(report, png));
}

/// FOLDER/light.NAME.png of each light group, all at the exposure of the whole image.
Status write_light_pictures(const Image& image, const Outputs& outputs) {
  RADFARM_TRY(const float exposure, exposure_of(image, outputs));
  for (const std::string& group : light_groups_of(image)) {
    const std::filesystem::path file = outputs.aov_png / ("light." + group + ".png");
    RADFARM_TRY(const std::vector<std::byte> png, encode_png(light_layer(image, group), exposure));
    RADFARM_TRY_STATUS(write_file_atomically(file, png));
    std::printf("%-28s as the image, at %.2f EV\n", file.filename().c_str(), static_cast<double>(exposure));
  }
  return {};
}

/// FOLDER/NAME.png of each AOV and light group of the image.
Status write_aov_pictures(std::span<const std::byte> exr, const Outputs& outputs) {
  const std::filesystem::path& folder = outputs.aov_png;
  RADFARM_TRY(const Image image, decode_exr(exr));
  const AovSet aovs = aovs_of(image);
  if (aovs == 0 && light_groups_of(image).empty()) {
    return fail(Code::kFailedPrecondition, "--aov-png: the image has no AOVs; render it with --aov");
  }
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error) return fail(Code::kPermissionDenied, folder.string() + ": cannot be created: " + error.message());
  for (std::size_t k = 0; k < kAovCount; ++k) {
    const auto aov = static_cast<Aov>(k);
    if (!contains(aovs, aov)) continue;
    const AovPicture picture = draw_aov(image, aov);
    const std::filesystem::path file = folder / (to_string(aov) + ".png");
    RADFARM_TRY(const std::vector<std::byte> png, encode_png(static_cast<std::uint32_t>(image.width),
                                                             static_cast<std::uint32_t>(image.height), picture.pixels));
    RADFARM_TRY_STATUS(write_file_atomically(file, png));
    std::printf("%-28s %s\n", file.filename().c_str(), picture.legend.c_str());
  }
  return write_light_pictures(image, outputs);
}

Status check_writable(const std::filesystem::path& folder, const std::filesystem::path& for_what) {
  if (::access(folder.c_str(), W_OK) == 0) return {};
  return fail(Code::kPermissionDenied, for_what.string() + ": cannot write into " + folder.string());
}

/// A folder that is there already, or that can be made.
Status check_picture_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (folder.empty() || !std::filesystem::is_directory(folder, ignored)) return check_folder(folder);
  return check_writable(folder, folder);
}

}  // namespace

Result<std::optional<float>> parse_exposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  float value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && stop == text.data() + text.size() && std::fabs(value) <= 100) return value;
  return fail(Code::kInvalidArgument, "--exposure: '" + text + "' is neither auto nor a number from -100 to 100");
}

Status check_folder(const std::filesystem::path& file) {
  if (file.empty()) return {};
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    return fail(Code::kNotFound, file.string() + ": the folder " + folder.string() + " does not exist");
  }
  if (std::filesystem::is_directory(file, ignored)) {
    return fail(Code::kInvalidArgument, file.string() + ": is a folder, must be a file");
  }
  return check_writable(folder, file);
}

void add_output_flags(CLI::App& app, Outputs& outputs) {
  app.add_option("-o,--output", outputs.exr, "OUT.exr: scene-linear image with its layers")->required();
  app.add_option("--png", outputs.png, "OUT.png: for viewing");
  app.add_option("--exposure", outputs.exposure, "EV (stops) or auto, for --png and the light groups of --aov-png");
  app.add_option("--aov-png", outputs.aov_png, "FOLDER for a NAME.png of each layer of --aov: false colours; light.NAME exposed as the image");
  app.add_option("--report", outputs.report, "OUT.json or OUT.html: settings, effects, times, counts, measured error");
}

Status check_usage(const Outputs& outputs) {
  if (outputs.exr.extension() != ".exr") {
    return fail(Code::kInvalidArgument, "-o: '" + outputs.exr.string() + "' must end in .exr");
  }
  if (!outputs.png.empty() && outputs.png.extension() != ".png") {
    return fail(Code::kInvalidArgument, "--png: '" + outputs.png.string() + "' must end in .png");
  }
  const std::filesystem::path kind = outputs.report.extension();
  if (!outputs.report.empty() && kind != ".json" && kind != ".html") {
    return fail(Code::kInvalidArgument, "--report: '" + outputs.report.string() + "' must end in .json or .html");
  }
  RADFARM_TRY(const std::optional<float> exposure, parse_exposure(outputs.exposure));
  (void)exposure;
  return {};
}

Status check_usage(const Outputs& outputs, const RenderRequest& request) {
  if (!outputs.aov_png.empty() && request.aov.empty()) {
    return fail(Code::kInvalidArgument, "--aov-png: needs --aov, such as --aov all");
  }
  return check_usage(outputs);
}

Status check_folders(const Outputs& outputs) {
  RADFARM_TRY_STATUS(check_folder(outputs.exr));
  RADFARM_TRY_STATUS(check_folder(outputs.png));
  RADFARM_TRY_STATUS(check_picture_folder(outputs.aov_png));
  return check_folder(outputs.report);
}

Result<nlohmann::json> deliver(FarmClient& client, const JobStatus& job, const Outputs& outputs,
                               const radfarm::Progress& progress) {
  RADFARM_TRY(const std::vector<std::byte> text, download(client, job, "report.json", progress));
  const auto* const begin = reinterpret_cast<const char*>(text.data());
  nlohmann::json report = nlohmann::json::parse(begin, begin + text.size(), nullptr, /*allow_exceptions=*/false);
  if (!report.is_object()) return fail(Code::kDataLoss, "job " + job.id + ": its report is not JSON");
  report["image"]["path"] = outputs.exr.string();

  RADFARM_TRY(const std::vector<std::byte> exr, download(client, job, "image.exr", progress));
  RADFARM_TRY_STATUS(progress.check());
  progress.report("write");
  RADFARM_TRY_STATUS(write_file_atomically(outputs.exr, exr));
  if (!outputs.png.empty()) RADFARM_TRY_STATUS(write_png(exr, outputs));
  if (!outputs.aov_png.empty()) RADFARM_TRY_STATUS(write_aov_pictures(exr, outputs));
  if (!outputs.report.empty()) RADFARM_TRY_STATUS(write_report(report, exr, outputs));
  return report;
}

Status check_succeeded(const JobStatus& job) {
  if (job.state == JobState::kSucceeded) return {};
  if (job.state == JobState::kCancelled) return fail(Code::kCancelled, "job " + job.id + " was cancelled");
  // A failed job is the input's fault for the shell, whatever went wrong inside (exit code 3).
  if (job.failure.reason == JobFailure::Reason::kSceneInvalid) {
    return fail(Code::kInvalidArgument, job.failure.error.message);
  }
  return fail(Code::kFailedPrecondition, to_string(job.failure.reason) + ": " + job.failure.error.message);
}

}  // namespace radfarm::cli
