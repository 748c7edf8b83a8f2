#pragma once

#include "base/status.h"
#include "effects/plan.h"
#include "estimate/settings.h"
#include "frame/request.h"
#include "pipeline/effort.h"
#include "pipeline/expected_cost.h"
#include "radiosity/solve.h"
#include "scene/scene.h"

namespace radfarm {

/// The view's camera in the recentred scene: from the file, from flags, or framed (is_framed).
struct ChosenCamera {
  Camera camera;
  bool is_framed = false;
};
Result<ChosenCamera> choose_camera(const Scene& scene, const RenderRequest& request);

/// What --quality, a target and the flags mean in counts and thresholds. Thresholds that depend on the scene's brightness stay 0
/// here and are set by prepare(), and so is what a target of seconds chooses. Pure.
Settings resolve_settings(const RenderRequest& request, const Camera& camera, const Effort& effort = {});

/// Photon paths for what diffuse surfaces have from specular ones, where a gather is to carry it (DESIGN 3, E_specular). Pure.
void resolve_specular_light(const RenderRequest& request, const EffectsPlan& plan, Settings& settings);

/// The sender threshold, cd/m^2, of so many just visible differences where a display shows the mean radiance as middle grey:
/// for views without a pilot image. And the mean radiance of a solution, cd/m^2.
float grey_threshold(float scale, float mean_radiance);
float mean_radiance(const RadiositySolution& solution);

/// Settings::noise as a share of the mean radiance; 0, all pixels alike, where somebody asked for a number of samples.
float noise_share(const RenderRequest& request, const Settings& settings);

/// Chooses the level that a target of seconds allows for, by what a render of each is expected to cost.
float level_in_time(const RenderRequest& request, const World& world, const Camera& camera, const PathPilot& pilot, int threads);

/// Chooses how much is audited: about a tenth of what the render is expected to cost, or what the target needs, up to a quarter.
void resolve_audit(const RenderRequest& request, const World& world, const PathPilot& pilot, Settings& settings);

/// First samples and noise of a path-traced view for a target, by the variance of single paths.
void resolve_paths(const RenderRequest& request, const PathPilot& pilot, int threads, Settings& settings);

}  // namespace radfarm
