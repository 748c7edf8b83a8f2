#pragma once

#include <filesystem>
#include <string>

#include "base/progress.h"
#include "cli/farm_client.h"
#include "frame/request.h"

namespace radfarm::cli {

/// Uploads what the farm lacks of a scene's files and creates the job. CANCELLED when `progress` is.
/// Phases: read, upload; in MiB.
Result<JobStatus> submit_scene(FarmClient& client, const std::filesystem::path& scene, const RenderRequest& request,
                               const radfarm::Progress& progress = {});

/// 128 random bits as hexadecimal digits, for request ids.
std::string new_request_id();

}  // namespace radfarm::cli
