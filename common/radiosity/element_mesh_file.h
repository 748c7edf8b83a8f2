#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/status.h"
#include "radiosity/element_mesh.h"

namespace radfarm {

/// The element mesh as a flat file of kind "elements", what workers get as the solution when the integrator is radiosity.
[[nodiscard]] std::vector<std::byte> encode(const ElementMesh& mesh);

/// `sides`: how many the scene has. Hostile bytes give DATA_LOSS: every index is checked, children come after their parent, outlines
/// run around their element, light is finite.
Result<ElementMesh> decode_element_mesh(std::span<const std::byte> bytes, std::size_t sides);

}  // namespace radfarm
