#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/irradiance.h"

namespace radfarm {

/// A place of one smooth surface and the light that arrives there.
struct MeshVertex {
  Vec3 position{0, 0, 0};
  Irradiance irradiance;
};

/// A vertex on the outline of an element: `along` is its place on its edge, 0 at the edge's first corner.
struct RingVertex {
  std::uint32_t vertex = 0;
  float along = 0;
};

/// One triangle side, or a part of it: divided into four by its edges' midpoints (subdivide()), or undivided, with its outline:
/// from corner to corner, with all vertices of neighbours between. Children have larger indices than their parent.
struct Element {
  std::uint32_t first_child = kNone;                    // of four; kNone: undivided
  std::uint32_t first_ring = 0;                         // into ElementMesh::ring
  std::array<std::uint32_t, 3> edge_vertices{0, 0, 0};  // of each edge, its first corner included, its last not
  std::uint32_t center = kNone;                         // the vertex in the middle of an element with more than three vertices

  bool is_undivided() const { return first_child == kNone; }
  std::uint32_t ring_size() const { return edge_vertices[0] + edge_vertices[1] + edge_vertices[2]; }
};

/// The solution as a mesh to be shown (Gouraud), without T-vertices: where a neighbour has a vertex on an element's edge, the
/// element has it too, so no crack shows and irradiance is continuous over smooth surfaces. Independent of any camera; stored
/// as the "solution" of a view (element_mesh_file.h).
struct ElementMesh {
  std::vector<MeshVertex> vertices;
  std::vector<Element> elements;
  std::vector<RingVertex> ring;
  std::vector<std::uint32_t> sides;  // the element of each triangle side by SideNumbers; kNone: no light gets there
};

/// docs/pipeline.md (mesh.2). The irradiance of a vertex is the mean of the elements around it, by their angles there, over
/// those on the same smooth surface: shading normals within 10 degrees, so never across a hard edge or through a sheet.
/// `irradiance` is one a node of `hierarchy`, used at undivided patches. Vertices belong together when their positions are equal
/// in every bit, as the midpoints of a shared edge are; surfaces that only touch keep their own. O(elements). Deterministic.
ElementMesh make_element_mesh(const World& world, const Hierarchy& hierarchy, std::span<const Irradiance> irradiance);

}  // namespace radfarm
