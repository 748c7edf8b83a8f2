#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/ladder_table.h"

namespace radfarm::cli {

/// Pictures of one row, PNG: the image, and by how much of the reference's luminance it is off.
struct RowPictures {
  std::vector<std::byte> image, difference;
};

struct LadderPage {
  std::string title;      // the scene
  std::string command;    // that makes the page again
  std::vector<LadderRow> rows;
  std::vector<RowPictures> pictures;     // one a row
  std::vector<std::byte> reference;      // PNG
  double reference_relative = 0;         // what the reference itself is off by noise
  double most_difference = 0;            // relative, that the difference pictures show as yellow
};

/// A page of one file: error against time with both axes logarithmic, the cheapest setting for an error, all rows, pictures.
std::string ladder_page(const LadderPage& page);

}  // namespace radfarm::cli
