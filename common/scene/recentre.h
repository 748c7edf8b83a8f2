#pragma once

#include "scene/draft_scene.h"
#include "scene/scene.h"

namespace radfarm {

/// Moves the scene so that its bulk lies about zero, in double, then rounds to float: geometry, instances, lights,
/// cameras. Scene::origin is what was subtracted: the area-weighted median of the triangles per axis (one stray object
/// does not move it), rounded to a power-of-two step of about a sixteenth of the scene so that round coordinates stay
/// round. A mesh whose own coordinates lie far from its own zero is moved there too, against its instances' transforms.
Scene recentre(DraftScene draft);

}  // namespace radfarm
