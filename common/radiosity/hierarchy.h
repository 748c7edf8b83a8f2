#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "math/spectrum.h"
#include "math/vec.h"
#include "radiosity/reach.h"
#include "scene/world.h"

namespace radfarm {

/// One side of a triangle or of a part of it: what receives, reflects and emits. The two sides of a triangle are two
/// patches, so nothing leaks through a single sheet (docs/pipeline.md, radiosity).
struct Patch {
  TriangleVertices vertices;      // counter-clockwise seen from this side
  Vec3 normal;                    // unit
  float offset = 0;               // ray offset, as SurfacePoint::offset
  Spectrum reflectance;           // rho, mean over the patch
  Spectrum emission;              // L_e from this side, mean over the patch, cd/m^2
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  std::uint32_t is_front = 1;     // whether it is the triangle's front side
  std::uint32_t is_textured_emitter = 0;
};

/// m^2
float area_of(const TriangleVertices& vertices);

/// A cluster (children: two) or a patch (children: none, or four parts). Children have larger indices than their parent.
struct Node {
  Box3 bounds;
  Vec3 cone_axis{0, 0, 1};        // unit; every patch normal below lies within the cone
  float cone_cosine = -1;         // of the half angle; -1: any direction
  float area = 0;                 // of all patches below, m^2
  Spectrum reflectance;           // area-weighted mean
  Spectrum emitted_power;         // pi L_e A summed, lm
  std::uint32_t parent = kNone;
  std::uint32_t first_child = kNone;
  std::uint32_t child_count = 0;
  std::uint32_t first_leaf = 0;   // clusters: the range of Hierarchy::leaves below; patches: their triangle side's
  std::uint32_t leaf_count = 0;
  std::uint32_t patch = kNone;    // index into patches; kNone for clusters

  bool is_cluster() const { return patch == kNone; }
};

/// Whether it is a patch without parts: what receives and reflects.
inline bool is_undivided(const Node& node) { return !node.is_cluster() && node.child_count == 0; }

/// The cluster hierarchy over all patches: node 0 is the root. Grows only by subdivide().
struct Hierarchy {
  std::vector<Node> nodes;
  std::vector<Patch> patches;
  std::vector<std::uint32_t> leaves;        // nodes of whole triangle sides, in tree order
  std::vector<Vec3> leaf_normals;           // over leaves: unit
  std::vector<double> area_before;          // over leaves: area before each, and the total last
  std::vector<double> emission_before;      // over leaves: emitted luminous power before each, and the total last
  std::vector<double> reflection_before;    // the same of reflected power, as last given to set_reflected_power()
  std::vector<float> reflected;             // luminance of reflected power, one a node, given with it
};

/// Clusters by build_cluster_tree(). Sides that no light reaches are left out. O(n log n) in the number of sides. Deterministic.
Hierarchy build_hierarchy(const World& world, const SideNumbers& sides, const std::vector<bool>& is_reachable,
                          const Progress& progress = {});

/// Cuts a patch into four by its edges' midpoints; returns the first of the four new nodes. Requires: no children yet.
std::uint32_t subdivide(Hierarchy& hierarchy, std::uint32_t node);

/// Which node holds the whole patch of each triangle side; kNone for sides left out. O(sides).
std::vector<std::uint32_t> nodes_of_sides(const SideNumbers& sides, const Hierarchy& hierarchy);

/// The part of a patch, in the order of subdivide(), in which a point lies, and the weights there of the part's vertices 1 and
/// 2; (b, c) are those in the whole.
struct PartPoint {
  std::uint32_t part = 0;
  double b = 0, c = 0;
};
PartPoint enter_part(double b, double c);

/// The undivided part of a whole patch in which a point of its plane lies; the node itself where it has no parts.
std::uint32_t part_at(const Hierarchy& hierarchy, std::uint32_t node, const Vec3& position);

/// Adds what stands at undivided patches to all nodes above; `power` is one a node, zero elsewhere.
void pull_up(const Hierarchy& hierarchy, std::vector<Spectrum>& power);

/// Lets sample_node() choose by what the nodes reflect now; `power` is one a node, lm.
void set_reflected_power(Hierarchy& hierarchy, const std::vector<Spectrum>& power);

/// A random point of a node's surfaces.
struct NodeSample {
  Vec3 position;
  Vec3 normal;
  float offset = 0;
  std::uint32_t patch = 0;
  Vec3 leave() const { return position + normal * offset; }
};
enum class SampleBy { kArea, kEmittedPower, kReflectedPower };
/// Uniform over the node's area, or over its area weighted by the luminance that its patches send. `choice` picks the
/// patch, `u` the point. Requires: `node` is one of hierarchy.nodes; by power only on nodes that have it.
NodeSample sample_node(const Hierarchy& hierarchy, const Node& node, SampleBy by, double choice, const Vec2& u);

}  // namespace radfarm
