#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radfarm {

/// Which of a scene's emitters shine: all by default. Those that do not still reflect and block light.
struct Shining {
  std::vector<std::uint8_t> materials;  // 1: surfaces of this material shine, one of each of the scene; none: all shine
  std::vector<std::uint8_t> lights;     // the same of punctual lights
  bool environment = true;

  bool material(std::size_t index) const { return materials.empty() || materials[index] != 0; }
  bool light(std::size_t index) const { return lights.empty() || lights[index] != 0; }
  friend bool operator==(const Shining&, const Shining&) = default;
};

}  // namespace radfarm
