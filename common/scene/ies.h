#pragma once

#include <string_view>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Reads a photometric file of IES LM-63 (1986, 1991, 1995, 2002, 2019), with TILT=NONE or TILT=INCLUDE, whose factors
/// count only for tilted lamps and are not applied. Candela are the file's times multiplier and ballast factor (and, up
/// to 1991, the ballast-lamp photometric factor). Tables of types A and B become type C, as do planes that cover 90 to
/// 270 degrees: docs/sky.md. INVALID_ARGUMENT with the line, UNIMPLEMENTED for tilt in a file of its own,
/// RESOURCE_EXHAUSTED for more angles than the limit.
Result<Photometry> read_ies(std::string_view text);

}  // namespace radfarm
