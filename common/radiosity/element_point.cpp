#include "radiosity/element_point.h"

#include <algorithm>
#include <utility>

namespace radfarm {
namespace {

/// Where the corner `k` of an element, or of k = 3 the first again, stands in mesh.ring.
std::uint32_t ring_of_corner(const Element& element, std::size_t k) {
  std::uint32_t ring = element.first_ring;
  for (std::size_t i = 0; i < k % 3; ++i) ring += element.edge_vertices[i];
  return ring;
}

struct Mixed {
  Irradiance sum;
  void add(const Irradiance& irradiance, double weight) {
    sum.direct += irradiance.direct * static_cast<float>(weight);
    sum.indirect += irradiance.indirect * static_cast<float>(weight);
  }
};

/// Adds the value at `along` of an edge, times `weight`: linear between the two vertices around it.
void add_on_edge(const ElementMesh& mesh, const Element& element, std::size_t edge, double along, double weight, Mixed& mixed) {
  const auto first = mesh.ring.begin() + ring_of_corner(element, edge);
  const auto last = first + element.edge_vertices[edge];
  const auto above = std::upper_bound(first + 1, last, along,
                                      [](double at, const RingVertex& v) { return at < static_cast<double>(v.along); });
  const RingVertex& from = *(above - 1);
  const bool is_last = above == last;
  const RingVertex& to = is_last ? mesh.ring[ring_of_corner(element, edge + 1)] : *above;
  const double end = is_last ? 1 : static_cast<double>(to.along), begin = static_cast<double>(from.along);
  const double share = std::clamp((along - begin) / (end - begin), 0.0, 1.0);
  mixed.add(mesh.vertices[from.vertex].irradiance, weight * (1 - share));
  mixed.add(mesh.vertices[to.vertex].irradiance, weight * share);
}

}  // namespace

ElementPoint locate(const ElementMesh& mesh, const SideNumbers& sides, const Surfaces& surfaces, const Hit& hit,
                    const SurfacePoint& point) {
  ElementPoint at{mesh.sides[sides.of(hit.instance, hit.triangle, point.is_front)], static_cast<double>(hit.u),
                  static_cast<double>(hit.v)};
  if (at.element == kNone) return at;
  // Both a mirrored instance and the back turn the order of the vertices.
  if (surfaces.is_mirrored(hit.instance) == point.is_front) std::swap(at.b, at.c);
  while (!mesh.elements[at.element].is_undivided()) {
    const PartPoint part = enter_part(at.b, at.c);
    at = {mesh.elements[at.element].first_child + part.part, part.b, part.c};
  }
  return at;
}

Irradiance interpolate(const ElementMesh& mesh, const ElementPoint& at) {
  const Element& element = mesh.elements[at.element];
  const std::array<double, 3> weights = {1 - at.b - at.c, at.b, at.c};
  Mixed mixed;
  if (element.center == kNone) {
    for (std::size_t k = 0; k < 3; ++k) {
      mixed.add(mesh.vertices[mesh.ring[element.first_ring + k].vertex].irradiance, std::clamp(weights[k], 0.0, 1.0));
    }
    return mixed.sum;
  }
  // The middle and the edge opposite to the least weight make the triangle in which the point lies.
  const auto least = static_cast<std::size_t>(std::min_element(weights.begin(), weights.end()) - weights.begin());
  const std::size_t edge = (least + 1) % 3;
  const double middle = std::clamp(3 * weights[least], 0.0, 1.0);
  mixed.add(mesh.vertices[element.center].irradiance, middle);
  if (middle < 1) {
    add_on_edge(mesh, element, edge, (weights[(edge + 1) % 3] - weights[least]) / (1 - middle), 1 - middle, mixed);
  }
  return mixed.sum;
}

TriangleVertices corners_of(const ElementMesh& mesh, const Element& element) {
  TriangleVertices corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[mesh.ring[ring_of_corner(element, k)].vertex].position;
  return corners;
}

void append_triangles(const ElementMesh& mesh, const Element& element, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto vertex = [&](std::uint32_t i) { return mesh.ring[element.first_ring + i % element.ring_size()].vertex; };
  if (element.center == kNone) {
    triangles.push_back({vertex(0), vertex(1), vertex(2)});
    return;
  }
  for (std::uint32_t i = 0; i < element.ring_size(); ++i) triangles.push_back({element.center, vertex(i), vertex(i + 1)});
}

}  // namespace radfarm
