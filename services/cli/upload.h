#pragma once

#include <filesystem>
#include <string>

#include "cli/events.h"
#include "cli/farm_client.h"
#include "frame/request.h"

namespace radfarm::cli {

/// Uploads what the farm lacks of a scene's files and creates the job. CANCELLED when interrupted in between.
Result<JobStatus> submit_scene(FarmClient& client, const std::filesystem::path& scene, const RenderRequest& request,
                               Events& events);

/// 128 random bits as hexadecimal digits, for request ids.
std::string new_request_id();

}  // namespace radfarm::cli
