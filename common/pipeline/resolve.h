#pragma once

#include "base/status.h"
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

/// The sender threshold that a quality stands for, as a share of the scene's mean radiance; and that mean, cd/m^2.
float threshold_share(RenderRequest::Quality quality);
float mean_radiance(const RadiositySolution& solution);

}  // namespace radfarm
