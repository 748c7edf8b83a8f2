#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace radfarm {

/// Named float channels over width x height pixels, row 0 at the top. Channel names are OpenEXR's: "R", "direct.G", "depth.Z".
struct Image {
  int width = 0;
  int height = 0;
  std::map<std::string, std::vector<float>> channels;  // each width * height long
  std::map<std::string, std::string> attributes;       // EXR header strings

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

}  // namespace radfarm
