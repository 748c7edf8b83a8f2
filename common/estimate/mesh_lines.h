#pragma once

#include "estimate/gouraud.h"
#include "estimate/render_tile.h"

namespace radfarm {

/// `radiance` with the edges of the elements drawn over it: what the camera sees first is darkened along them, in lines about
/// one pixel wide, whose coverage falls linearly with the distance on the film. One more ray a sample. For looking at a mesh:
/// the image is no measurement any more, and is not audited. `context` is kept, and must outlive the result.
SampleRadiance with_mesh_lines(SampleRadiance radiance, const GouraudContext& context, const Film& film);

/// How far, in pixels, the nearest edge of a triangle is on the film from a ray that meets its plane at `position`.
float pixels_to_edge(const TriangleVertices& triangle, const Vec3& position, const Film& film);

}  // namespace radfarm
