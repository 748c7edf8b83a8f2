#pragma once

#include <optional>
#include <vector>

#include "base/status.h"
#include "meters/meter.h"
#include "scene/world.h"

namespace radfarm {

struct WorkPlaneSettings {
  float height = 0.85F;        // m above the floor
  float spacing = 0.25F;       // m
  std::optional<float> floor;  // y of the floor, in the scene's coordinates; default: found
};

/// A horizontal grid of meters that look up, over the floor inside the walls.
struct WorkPlane {
  float floor = 0;       // y, m
  Vec3 corner{0, 0, 0};  // of cell (0, 0), least x and z
  float spacing = 0;
  std::size_t columns = 0, rows = 0;    // along x, along z
  std::vector<std::uint32_t> meter_of;  // one a cell, row by row; kNone: none there
  std::vector<Meter> meters;            // at the cells' centres
};

/// The floor is the lowest level whose surfaces that face up have at least a quarter of the area of the largest such
/// level. A cell has a meter where its centre is over the floor, not inside a solid, and, if a quarter have something
/// above, under it: so what lies outside the walls is left out. Places of less than 1 m^2 that no gap joins to others
/// are left out too: cupboards. INVALID_ARGUMENT where no floor or no cell is found, or the grid has above 10^7 cells.
Result<WorkPlane> make_work_plane(const World& world, const WorkPlaneSettings& settings);

}  // namespace radfarm
