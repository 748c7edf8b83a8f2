#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "cli/farm_client.h"
#include "frame/request.h"
#include "process/exit_code.h"

namespace radfarm::cli {

/// Where the results go.
struct Outputs {
  std::filesystem::path exr;
  std::filesystem::path png, report;  // empty: not wanted
  std::string exposure = "auto";      // EV or auto
  std::filesystem::path aov_png = {};  // folder for pictures of the AOVs; empty: not wanted
};

void add_output_flags(CLI::App& app, Outputs& outputs);

/// INVALID_ARGUMENT when a name or the exposure cannot be; PERMISSION_DENIED or NOT_FOUND when a folder is not there,
/// so that nobody learns it only after the render.
Status check_usage(const Outputs& outputs);
/// The same, and INVALID_ARGUMENT when pictures are wanted of layers that the request does not name.
Status check_usage(const Outputs& outputs, const RenderRequest& request);
/// Nothing for "auto".
Result<std::optional<float>> parse_exposure(const std::string& text);
Status check_folder(const std::filesystem::path& file);
Status check_folders(const Outputs& outputs);

/// Downloads the image and the report of a finished job, writes what is wanted, each file whole or not at all, and says on stdout
/// what the colours of the AOVs mean. Returns the report. CANCELLED when `progress` is, before the first file is written.
Result<nlohmann::json> deliver(FarmClient& client, const JobStatus& job, const Outputs& outputs,
                               const radfarm::Progress& progress);

/// The error that a job's end means, or nothing for SUCCEEDED.
Status check_succeeded(const JobStatus& job);

/// How a command ends that waited for a job that succeeded.
inline ExitCode exit_code_of(const JobStatus& job) { return job.target_missed ? ExitCode::kTargetNotMet : ExitCode::kDone; }

}  // namespace radfarm::cli
