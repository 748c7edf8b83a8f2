#pragma once

#include <cstdint>
#include <vector>

#include "paths/disc.h"
#include "scene/scene.h"

namespace radfarm::bench {

/// Scenes for photon paths, made up; metres. Leaves are squares that turn every way but down.
Scene plain_room();                                  // 4 x 3 x 4 m, a lamp of .8 m under the ceiling
Scene leaf_cloud(std::uint32_t leaves, float side);  // in a ball of radius 1, over a floor, under a lamp of 1 m
Scene shadow_plane();                                // [3, fig. 1]: a plane over a plane
Scene waves();                                       // one mesh with hollows [3, fig. 10]
Scene table();                                       // a top with edges, a bar close above it [3, figs. 16 to 18]
/// As large as [3, fig. 15]: a room of bounding sphere radius 10 m with 16 balls, one vertex of the 46,701 a disc of .2
/// m.
Scene paper_room();
std::vector<Disc> paper_discs(const World& world, const Components& components);

/// Points evenly by area on surfaces that face up, on their upper side: discs of that radius.
std::vector<Disc> upper_discs(const World& world, const Components& components, std::size_t count, float radius);

}  // namespace radfarm::bench
