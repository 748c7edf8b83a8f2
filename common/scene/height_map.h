#pragma once

#include "scene/scene.h"

namespace radfarm {

/// The tangent-space normal map of a height map, by central differences: a grey value of 1 is as high as `scale` texels
/// are wide. Green points up in the image, as in glTF. Borders follow the texture's wrap modes.
Texture normal_map_of_heights(const Texture& heights, double scale);

/// Whether an image looks like a tangent-space normal map (mostly blue) rather than heights (grey).
bool looks_like_normal_map(const Texture& image);

}  // namespace radfarm
