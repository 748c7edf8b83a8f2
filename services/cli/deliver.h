#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/farm_client.h"

namespace radfarm::cli {

/// Where the results go.
struct Outputs {
  std::filesystem::path exr;
  std::filesystem::path png, report;  // empty: not wanted
  std::string exposure = "auto";      // EV or auto
};

void add_output_flags(CLI::App& app, Outputs& outputs);

/// INVALID_ARGUMENT when a name or the exposure cannot be; PERMISSION_DENIED or NOT_FOUND when a folder is not there,
/// so that nobody learns it only after the render.
Status check_usage(const Outputs& outputs);
/// Nothing for "auto".
Result<std::optional<float>> parse_exposure(const std::string& text);
Status check_folder(const std::filesystem::path& file);
Status check_folders(const Outputs& outputs);

/// Downloads the image and the report of a finished job, writes what is wanted, each file whole or not at all. Returns
/// the report.
Result<nlohmann::json> deliver(FarmClient& client, const JobStatus& job, const Outputs& outputs);

/// The error that a job's end means, or nothing for SUCCEEDED.
Status check_succeeded(const JobStatus& job);

}  // namespace radfarm::cli
