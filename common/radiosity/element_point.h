#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/element_mesh.h"

namespace radfarm {

/// An undivided element, and a point in it as the weights of its corners 1 and 2.
struct ElementPoint {
  std::uint32_t element = kNone;
  double b = 0, c = 0;
};

/// The element at a hit by the side that `point` shows; element kNone where no light gets. O(depth).
ElementPoint locate(const ElementMesh& mesh, const SideNumbers& sides, const Surfaces& surfaces, const Hit& hit,
                    const SurfacePoint& point);

/// Linear in the triangles of the element, so continuous across its edges. O(log vertices). Requires: `at` is in an element.
Irradiance interpolate(const ElementMesh& mesh, const ElementPoint& at);

/// The corners of an undivided element, counter-clockwise seen from its side.
TriangleVertices corners_of(const ElementMesh& mesh, const Element& element);

/// Appends an undivided element's triangles as indices into mesh.vertices, counter-clockwise seen from its side.
void append_triangles(const ElementMesh& mesh, const Element& element, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace radfarm
