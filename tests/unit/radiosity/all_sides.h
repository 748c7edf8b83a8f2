#pragma once

#include <string>
#include <vector>

#include "radiosity/light_paths.h"
#include "support/small_scenes.h"

namespace radfarm::test {

/// A scene with all its sides in a hierarchy.
struct Sides {
  explicit Sides(const std::string& name)
      : world(own_scene(name)),
        sides(world.scene),
        hierarchy(build_hierarchy(world, sides, std::vector<bool>(sides.count, true))) {}

  World world;
  SideNumbers sides;
  Hierarchy hierarchy;
};

inline double sum_of(const std::vector<SpectrumD>& values) {
  double sum = 0;
  for (const SpectrumD& value : values) sum += luminance(value);
  return sum;
}

}  // namespace radfarm::test
