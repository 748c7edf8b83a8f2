#include "cli/render_job.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "cli/follow.h"
#include "cli/phase_display.h"
#include "cli/solution_folder.h"
#include "cli/upload.h"

namespace radfarm::cli {

LocalFarm::Options local_farm_options(int workers, int threads, bool no_cache) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return {workers, threads > 0 ? threads : std::max(1, cores / workers), no_cache ? "" : solution_folder()};
}

Result<RenderedJob> render_job(LocalFarm& farm, const std::filesystem::path& scene, const RenderRequest& request,
                               const Outputs& outputs, Events& events) {
  FarmClient client(farm.address());
  PhaseDisplay submitting(Progress::style_for_stderr(), JobState::kQueued);
  RADFARM_TRY(const JobStatus job, submit_scene(client, scene, request, submitting.progress(events.interruption())));
  Progress progress(Progress::style_for_stderr());
  FollowOptions options;
  options.on_interrupt = FollowOptions::OnInterrupt::kCancelJob;
  options.check_children = [&] { return farm.check(); };
  Result<JobStatus> done = follow(client, job.id, options, events, progress);
  progress.finish();
  if (!done) return tl::unexpected(done.error());
  RADFARM_TRY_STATUS(check_succeeded(*done));
  PhaseDisplay delivering(Progress::style_for_stderr(), JobState::kSucceeded);
  RADFARM_TRY(nlohmann::json report, deliver(client, *done, outputs, delivering.progress(events.interruption())));
  return RenderedJob{std::move(*done), std::move(report)};
}

}  // namespace radfarm::cli
