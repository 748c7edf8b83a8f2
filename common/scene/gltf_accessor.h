#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_model.h"

namespace radfarm {

/// The elements of an accessor as floats, `components` a piece, one after the other: any component type, normalized
/// integers scaled as glTF says, sparse values put in place, zeros without a buffer view. Fewer components than the
/// file has cuts the rest, more fills with 1 (alpha). INVALID_ARGUMENT for values that are not finite. Requires: an
/// accessor that check_gltf() has passed.
Result<std::vector<float>> read_floats(const GltfModel& model, int accessor, std::size_t components);

/// The elements of an index accessor. Requires: a checked accessor of an unsigned integer type.
std::vector<std::uint32_t> read_indices(const GltfModel& model, int accessor);

}  // namespace radfarm
