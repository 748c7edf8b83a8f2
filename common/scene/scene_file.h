#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// The scene as one flat file (docs/formats.md, kind "scene"), and back. encode(decode(b)) == b; equal scenes give equal
/// bytes, so the file's SHA-256 is the scene's digest. decode_scene validates: hostile bytes give DATA_LOSS or
/// INVALID_ARGUMENT.
[[nodiscard]] std::vector<std::byte> encode_scene(const Scene& scene);
Result<Scene> decode_scene(std::span<const std::byte> bytes);

}  // namespace radfarm
