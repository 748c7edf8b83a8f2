#pragma once

#include <vector>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// A table as an IES file has it: `candela` is horizontal.size() rows of vertical.size().
struct IesTable {
  enum class Type { kC = 1, kB = 2, kA = 3 };
  Type type = Type::kC;
  std::vector<double> vertical;    // degrees, ascending
  std::vector<double> horizontal;  // degrees, ascending
  std::vector<double> candela;
};

/// The same in type C as Photometry has it. Type C keeps its angles, but for planes from 90 to 270 degrees, which are
/// mirrored into all around, and planes that end before 360, where the first one is repeated. A light of type A or B
/// shines along its direction at (0, 0), horizontal angles grow towards `right`; it is resampled as finely as its
/// finest step, within 1/4 and 1 degree, and scaled to the flux of the file's own table. INVALID_ARGUMENT says which
/// angles are wrong.
Result<Photometry> to_type_c(const IesTable& table);

}  // namespace radfarm
