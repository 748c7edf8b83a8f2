#pragma once

#include <filesystem>
#include <vector>

#include "base/status.h"

namespace radfarm::bench {

/// A grey picture: values row by row, from the top.
struct Panel {
  int width = 0, height = 0;
  std::vector<double> values;
};

/// Panels of one size, in rows, with a line between them; each pixel `scale` across; `white` and above is white, in
/// sRGB.
Status write_panels(const std::filesystem::path& file, const std::vector<std::vector<Panel>>& rows, double white,
                    int scale);

/// The value that so large a share of the pixels stays below.
double quantile_of(const Panel& panel, double share);

}  // namespace radfarm::bench
