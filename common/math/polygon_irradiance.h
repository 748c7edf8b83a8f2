#pragma once

#include <span>

#include "math/vec.h"

namespace radfarm {

/// Most vertices of a polygon that the functions below take.
inline constexpr std::size_t kMaxPolygonVertices = 8;

/// Unoccluded form factor from a point to a polygon: F = E / (pi L) for a polygon that emits the same radiance L everywhere,
/// in [0, 1], by Lambert's formula F = 1/(2 pi) |sum_i Theta_i Gamma_i . n| over the edges of what stands above the
/// receiver's horizon. [Baum, Rushmeier and Winget 1989; ALGORITHMS U4]
///
/// Both windings give the same; which side emits is the caller's business. Accurate to about 1e-15 absolute and, however
/// small the polygon looks, to a few ulp of the vertices' differences relative: areas are summed from differences of unit
/// vectors, not from the unit vectors. A polygon with no vertex strictly above the horizon gives 0. A receiver on the
/// polygon's rim gets the limit from the side of its plane that `normal` points away from: 1/2 at the foot of a wall.
/// Cost: about 30 ns an edge.
/// Requires: convex, planar, 3 to kMaxPolygonVertices vertices, `normal` of unit length.
double polygon_form_factor(std::span<const Vec3d> polygon, const Vec3d& receiver, const Vec3d& normal);

/// The same to 1e-8 absolute and about 1e-6 relative, for inner loops: a polynomial stands for the arc cosine. Vertices and
/// result are floats, differences are taken in double.
float fast_polygon_form_factor(std::span<const Vec3> polygon, const Vec3& receiver, const Vec3& normal);

}  // namespace radfarm
