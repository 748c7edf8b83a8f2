#pragma once

#include "base/status.h"
#include "effects/plan.h"
#include "estimate/settings.h"
#include "frame/request.h"
#include "radiosity/solve.h"
#include "scene/scene.h"

namespace radfarm {

/// The view's camera in the recentred scene: from the file, from flags, or framed (is_framed).
struct ChosenCamera {
  Camera camera;
  bool is_framed = false;
};
Result<ChosenCamera> choose_camera(const Scene& scene, const RenderRequest& request);

/// What --quality and the flags mean in counts and thresholds. Thresholds that depend on the scene's brightness stay 0
/// here and are set by prepare(). Pure.
Settings resolve_settings(const RenderRequest& request, const Camera& camera);

/// Photon paths for what diffuse surfaces have from specular ones, where a gather is to carry it (DESIGN 3, E_specular). Pure.
void resolve_specular_light(const RenderRequest& request, const EffectsPlan& plan, Settings& settings);

/// The sender threshold, cd/m^2, of so many just visible differences where a display shows the mean radiance as middle grey:
/// for views without a pilot image. And the mean radiance of a solution, cd/m^2.
float grey_threshold(float scale, float mean_radiance);
float mean_radiance(const RadiositySolution& solution);

/// Settings::noise as a share of the mean radiance; 0, all pixels alike, where somebody asked for a number of samples.
float noise_share(const RenderRequest& request);

}  // namespace radfarm
