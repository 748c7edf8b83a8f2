#include "radiosity/element_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "base/random.h"
#include "radiosity/deliveries.h"

namespace radfarm {
namespace {

constexpr float kSmoothCosine = 0.9848F;  // of 10 degrees

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    return combine(std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z));
  }
};
/// The number of each place where an element has a corner. Positions are compared by value: -0 is 0.
using Places = std::unordered_map<Vec3, std::uint32_t, PositionHash>;

Vec3 without_negative_zeros(const Vec3& p) { return p + Vec3(0, 0, 0); }

/// One element meeting one place: an entry of its outline.
struct Incidence {
  std::uint32_t place = 0;
  std::uint32_t ring = 0;
  std::uint32_t node = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 1};  // the shading normal that a viewer of its side sees there
  double angle = 0;      // that the element has at the place
};

/// The elements of all sides, parents first; `nodes` is the hierarchy's node behind each.
std::vector<std::uint32_t> number_elements(const SideNumbers& sides, const Hierarchy& hierarchy, ElementMesh& mesh) {
  std::vector<std::uint32_t> nodes;
  mesh.sides = nodes_of_sides(sides, hierarchy);
  for (std::uint32_t& side : mesh.sides) {
    if (side == kNone) continue;
    nodes.push_back(side);
    side = static_cast<std::uint32_t>(nodes.size() - 1);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[nodes[i]];
    Element element;
    if (!is_undivided(node)) element.first_child = static_cast<std::uint32_t>(nodes.size());
    for (std::uint32_t c = 0; c < node.child_count; ++c) nodes.push_back(node.first_child + c);
    mesh.elements.push_back(element);
  }
  return nodes;
}

double angle_between(const Vec3& a, const Vec3& b) {
  const Vec3d u = to_double(a), v = to_double(b);
  return std::atan2(length(cross(u, v)), dot(u, v));
}

/// Finds the outlines of undivided elements.
class Outlines {
 public:
  Outlines(const World& world, const Hierarchy& hierarchy, const std::vector<std::uint32_t>& nodes, ElementMesh& mesh)
      : world_(world), hierarchy_(hierarchy), mesh_(mesh) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!mesh.elements[i].is_undivided()) continue;
      for (const Vec3& corner : patch_of(nodes[i]).vertices) {
        places_.try_emplace(without_negative_zeros(corner), static_cast<std::uint32_t>(places_.size()));
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (mesh.elements[i].is_undivided()) trace(nodes[i], mesh.elements[i]);
    }
  }

  std::vector<Incidence> take() { return std::move(incidences_); }

 private:
  const Patch& patch_of(std::uint32_t node) const { return hierarchy_.patches[hierarchy_.nodes[node].patch]; }

  void trace(std::uint32_t node, Element& element) {
    const TriangleVertices& v = patch_of(node).vertices;
    element.first_ring = static_cast<std::uint32_t>(mesh_.ring.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t before = mesh_.ring.size();
      const Vec3 next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
      meet(node, v[k], 0, angle_between(next - v[k], previous - v[k]));
      trace_edge(node, v[k], next, 0, 1);
      element.edge_vertices[k] = static_cast<std::uint32_t>(mesh_.ring.size() - before);
    }
  }

  /// Adds the vertices between two points of an edge: subdivide() makes its midpoints by the same sum, seen from either side.
  void trace_edge(std::uint32_t node, const Vec3& a, const Vec3& b, float along_a, float along_b) {
    const Vec3 middle = without_negative_zeros((a + b) * 0.5F);
    if (middle == a || middle == b || !places_.contains(middle)) return;
    const float along = (along_a + along_b) / 2;
    trace_edge(node, a, middle, along_a, along);
    meet(node, middle, along, std::numbers::pi);
    trace_edge(node, middle, b, along, along_b);
  }

  void meet(std::uint32_t node, const Vec3& position, float along, double angle) {
    const Patch& patch = patch_of(node);
    SurfacePoint point = world_.surfaces.at(world_.surfaces.hit_at(patch.instance, patch.triangle, position));
    face(point, patch.normal);
    const auto ring = static_cast<std::uint32_t>(mesh_.ring.size());
    incidences_.push_back({places_.at(without_negative_zeros(position)), ring, node, position, point.shading_normal, angle});
    mesh_.ring.push_back({kNone, along});
  }

  const World& world_;
  const Hierarchy& hierarchy_;
  ElementMesh& mesh_;
  Places places_;
  std::vector<Incidence> incidences_;
};

/// A vertex under construction: elements that meet at one place on one smooth surface.
struct SmoothGroup {
  Vec3 normal{0, 0, 1};
  Vec3 position{0, 0, 0};
  double angle = 0;
  SpectrumD direct, indirect;
  std::vector<std::uint32_t> ring;
};

void add(const Incidence& one, const Irradiance& irradiance, std::vector<SmoothGroup>& groups) {
  auto group = std::find_if(groups.begin(), groups.end(),
                            [&](const SmoothGroup& g) { return dot(g.normal, one.normal) > kSmoothCosine; });
  if (group == groups.end()) group = groups.insert(groups.end(), SmoothGroup{one.normal, one.position, 0, {}, {}, {}});
  group->angle += one.angle;
  group->direct += SpectrumD(irradiance.direct) * one.angle;
  group->indirect += SpectrumD(irradiance.indirect) * one.angle;
  group->ring.push_back(one.ring);
}

void make_vertices(const std::vector<SmoothGroup>& groups, ElementMesh& mesh) {
  for (const SmoothGroup& group : groups) {
    for (const std::uint32_t ring : group.ring) mesh.ring[ring].vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    const double angle = group.angle > 0 ? group.angle : 1;
    mesh.vertices.push_back({group.position, {Spectrum(group.direct / angle), Spectrum(group.indirect / angle)}});
  }
}

/// Incidences of each place together, in their order.
std::vector<Incidence> sorted_by_place(std::vector<Incidence> incidences) {
  std::stable_sort(incidences.begin(), incidences.end(),
                   [](const Incidence& a, const Incidence& b) { return a.place < b.place; });
  return incidences;
}

/// The middle of an element whose outline has more than its corners has the element's own value.
void add_center(const Patch& patch, const Irradiance& irradiance, Element& element, ElementMesh& mesh) {
  if (!element.is_undivided() || element.ring_size() == 3) return;
  element.center = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({(patch.vertices[0] + patch.vertices[1] + patch.vertices[2]) / 3, irradiance});
}

}  // namespace

ElementMesh make_element_mesh(const World& world, const Hierarchy& hierarchy, std::span<const Irradiance> irradiance) {
  ElementMesh mesh;
  const std::vector<std::uint32_t> nodes = number_elements(SideNumbers(world.scene), hierarchy, mesh);
  const std::vector<Incidence> incidences = sorted_by_place(Outlines(world, hierarchy, nodes, mesh).take());
  std::vector<SmoothGroup> groups;
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    add(incidences[i], irradiance[incidences[i].node], groups);
    if (i + 1 < incidences.size() && incidences[i + 1].place == incidences[i].place) continue;
    make_vertices(groups, mesh);
    groups.clear();
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[nodes[i]];
    add_center(hierarchy.patches[node.patch], irradiance[nodes[i]], mesh.elements[i], mesh);
  }
  return mesh;
}

}  // namespace radfarm
