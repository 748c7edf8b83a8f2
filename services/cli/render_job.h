#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/deliver.h"
#include "cli/events.h"
#include "cli/farm_client.h"
#include "cli/local_farm.h"
#include "frame/request.h"

namespace radfarm::cli {

/// A local farm as flags ask for it: threads 0 are the machine's cores shared out among the workers.
LocalFarm::Options local_farm_options(int workers, int threads, bool no_cache);

/// One job from its scene to its files, with its progress on stderr. `job` is as it ended, `report` what it left.
struct RenderedJob {
  JobStatus job;
  nlohmann::json report;
};

/// Ctrl-C (`events`) cancels the job. Errors: what submit_scene(), follow() and deliver() refuse, and the job's own.
Result<RenderedJob> render_job(LocalFarm& farm, const std::filesystem::path& scene, const RenderRequest& request,
                               const Outputs& outputs, Events& events);

}  // namespace radfarm::cli
