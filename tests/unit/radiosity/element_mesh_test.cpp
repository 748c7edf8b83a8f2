#include "radiosity/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "radiosity/deliveries.h"
#include "radiosity/element_mesh_file.h"
#include "radiosity/element_point.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

/// A closed box with a sheet in it, which has light on both sides and touches nothing.
Scene box_with_sheet() {
  test::SceneMaker maker;
  const std::uint32_t grey = maker.material(Spectrum(0.5F));
  maker.room({grey, grey, grey, grey, grey, grey}, {-1, -1, -2}, {1, 1, 2});
  maker.polygon(grey, {{-0.75F, -0.75F, 0.25F}, {0.75F, -0.75F, 0.25F}, {0.75F, 0.5F, 0.25F}, {-0.75F, 0.5F, 0.25F}});
  return maker.take();
}

/// A scene whose patches are cut at random, neighbours to depths that differ by any number.
struct Refined {
  explicit Refined(Scene scene, std::uint64_t seed, int cuts = 150) : world(std::move(scene)), sides(world.scene) {
    hierarchy = build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
    RandomSequence random(seed);
    for (int i = 0; i < cuts;) {
      const auto node = static_cast<std::uint32_t>(random.bits() % hierarchy.nodes.size());
      if (is_undivided(hierarchy.nodes[node])) subdivide(hierarchy, node), ++i;
    }
  }
  /// Light by the node, as `value(patch)` says.
  template <typename Value>
  ElementMesh mesh(const Value& value) const {
    std::vector<Irradiance> irradiance(hierarchy.nodes.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
      if (is_undivided(hierarchy.nodes[i])) irradiance[i].direct = Spectrum(value(hierarchy.patches[hierarchy.nodes[i].patch]));
    }
    return make_element_mesh(world, hierarchy, irradiance);
  }

  World world;
  SideNumbers sides;
  Hierarchy hierarchy;
};

float one(const Patch&) { return 1; }

Vec3 place(const ElementMesh& mesh, const Element& element, std::uint32_t i) {
  return mesh.vertices[mesh.ring[element.first_ring + i % element.ring_size()].vertex].position;
}

/// Whether a point lies inside a segment, not at its ends. The tests' lengths are dyadic, so that rounding plays no part.
bool splits(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const float t = dot(p - a, along) / dot(along, along);
  return t > 0 && t < 1 && length(p - a - along * t) < 1e-5F * length(along);
}

TEST(ElementMesh, HasNoVertexInsideAnEdge) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Refined refined(box_with_sheet(), seed);
    const ElementMesh mesh = refined.mesh(one);
    std::vector<Vec3> corners;
    for (const MeshVertex& vertex : mesh.vertices) corners.push_back(vertex.position);
    for (const Element& element : mesh.elements) {
      // The middle of an element is no corner of another, and lies on no edge.
      for (std::uint32_t i = 0; element.is_undivided() && i < element.ring_size(); ++i) {
        const Vec3 a = place(mesh, element, i), b = place(mesh, element, i + 1);
        ASSERT_TRUE(std::none_of(corners.begin(), corners.end(), [&](const Vec3& p) { return splits(p, a, b); }));
      }
    }
  }
}

TEST(ElementMesh, TrianglesCoverTheirElementAndTurnItsWay) {
  const Refined refined(box_with_sheet(), 4);
  const ElementMesh mesh = refined.mesh(one);
  for (const Element& element : mesh.elements) {
    if (!element.is_undivided()) continue;
    const TriangleVertices v = corners_of(mesh, element);
    const Vec3 whole = cross(v[1] - v[0], v[2] - v[0]);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    append_triangles(mesh, element, triangles);
    Vec3 sum(0, 0, 0);
    for (const auto& t : triangles) {
      const Vec3 a = mesh.vertices[t[0]].position;
      const Vec3 part = cross(mesh.vertices[t[1]].position - a, mesh.vertices[t[2]].position - a);
      EXPECT_GT(dot(part, whole), 0);
      sum += part;
    }
    EXPECT_LT(length(sum - whole), 1e-5F * length(whole));
  }
}

TEST(ElementMesh, KeepsTheLightOfFacesAndOfBothSidesApart) {
  const auto by_side = [](const Patch& p) { return 100 + 50 * p.normal.x + 20 * p.normal.y + 10 * p.normal.z; };
  const Refined refined(box_with_sheet(), 5);
  const ElementMesh mesh = refined.mesh(by_side);
  RandomSequence random(6);
  for (int n = 0; n < 2000; ++n) {
    const Patch& patch = refined.hierarchy.patches[random.bits() % refined.hierarchy.patches.size()];
    const Hit hit = refined.world.surfaces.hit_at(patch.instance, patch.triangle, (patch.vertices[0] + patch.vertices[1] + patch.vertices[2]) / 3);
    SurfacePoint point = refined.world.surfaces.at(hit);
    face(point, patch.normal);
    const ElementPoint at = locate(mesh, refined.sides, refined.world.surfaces, hit, point);
    EXPECT_NEAR(interpolate(mesh, at).direct.g, by_side(patch), 1e-4F * by_side(patch));
  }
}

/// A scene with one instance that is mirrored.
Scene mirrored() {
  Scene scene = box_with_sheet();
  scene.instances[2].to_world[0][0] = -1;
  return scene;
}

TEST(ElementMesh, FindsTheElementInWhichAPointLies) {
  for (const auto& make : {box_with_sheet, mirrored}) {
    const Refined refined(make(), 7);
    const ElementMesh mesh = refined.mesh(one);
    RandomSequence random(8);
    for (int n = 0; n < 5000; ++n) {
      const auto instance = static_cast<std::uint32_t>(random.bits() % refined.world.scene.instances.size());
      float u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Hit hit{instance, static_cast<std::uint32_t>(random.bits() % 2), u, v, 0};
      SurfacePoint point = refined.world.surfaces.at(hit);
      face(point, random.bits() % 2 == 0 ? point.geometric_normal : -point.geometric_normal);
      const ElementPoint at = locate(mesh, refined.sides, refined.world.surfaces, hit, point);
      const TriangleVertices corners = corners_of(mesh, mesh.elements[at.element]);
      EXPECT_GT(dot(cross(corners[1] - corners[0], corners[2] - corners[0]), point.geometric_normal), 0);
      const Vec3 found = corners[0] * static_cast<float>(1 - at.b - at.c) + corners[1] * static_cast<float>(at.b) +
                         corners[2] * static_cast<float>(at.c);
      EXPECT_LT(length(found - point.position), 1e-5F);
      EXPECT_GE(std::min({at.b, at.c, 1 - at.b - at.c}), -1e-5);
    }
  }
}

TEST(ElementMesh, IsLinearBetweenTheVerticesOfAnEdge) {
  RandomSequence random(9);
  const Refined refined(box_with_sheet(), 10);
  const ElementMesh mesh = refined.mesh([&](const Patch&) { return random.uniform(); });
  for (std::uint32_t e = 0; e < mesh.elements.size(); ++e) {
    const Element& element = mesh.elements[e];
    std::uint32_t ring = element.first_ring;
    for (std::size_t edge = 0; element.is_undivided() && edge < 3; ++edge) {
      for (std::uint32_t i = 0; i < element.edge_vertices[edge]; ++i, ++ring) {
        const bool is_last = i + 1 == element.edge_vertices[edge];
        const RingVertex from = mesh.ring[ring];
        const RingVertex to = mesh.ring[element.first_ring + (ring + 1 - element.first_ring) % element.ring_size()];
        const double end = is_last ? 1 : static_cast<double>(to.along), t = (static_cast<double>(from.along) + end) / 2;
        std::array<double, 3> weights{};
        weights[edge] = 1 - t;
        weights[(edge + 1) % 3] = t;
        const float middle = (mesh.vertices[from.vertex].irradiance.direct.g + mesh.vertices[to.vertex].irradiance.direct.g) / 2;
        EXPECT_NEAR(interpolate(mesh, {e, weights[1], weights[2]}).direct.g, middle, 1e-5F);
      }
    }
  }
}

/// Irradiance times area over the mesh's triangles.
double light_of(const ElementMesh& mesh) {
  double sum = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Element& element : mesh.elements) {
    if (element.is_undivided()) append_triangles(mesh, element, triangles);
  }
  for (const auto& t : triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[t[k]]; };
    const float area = area_of({at(0).position, at(1).position, at(2).position});
    for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(at(k).irradiance.direct.g * area) / 3;
  }
  return sum;
}

// Interpolation shares light out between neighbours, without taking sides: over fields of independent random elements the
// difference has mean 0. Student's t at level 1e-6.
TEST(ElementMesh, HoldsTheLightOfItsElements) {
  const Refined refined(box_with_sheet(), 11, 60);
  RandomSequence random(12);
  RunningStatistics difference;
  constexpr int kFields = 200;
  for (int n = 0; n < kFields; ++n) {
    double elements = 0;
    const ElementMesh mesh = refined.mesh([&](const Patch& patch) {
      const float value = random.uniform();
      elements += static_cast<double>(value * area_of(patch.vertices));
      return value;
    });
    difference.add(light_of(mesh) / elements - 1);
  }
  const double deviations = student_t_quantile(1 - 1e-6 / 2, kFields - 1);
  EXPECT_LT(std::fabs(difference.mean()), deviations * difference.standard_error());
  const double area = static_cast<double>(refined.hierarchy.nodes[0].area);
  EXPECT_NEAR(light_of(refined.mesh(one)), area, 1e-4 * area) << "even light stays as it is";
}

TEST(ElementMeshFile, RoundTripKeepsEveryByte) {
  const Refined refined(box_with_sheet(), 13);
  const std::vector<std::byte> bytes = encode(refined.mesh(one));
  const Result<ElementMesh> again = decode_element_mesh(bytes, refined.sides.count);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(*again), bytes);
  EXPECT_EQ(decode_element_mesh(bytes, refined.sides.count + 2).error().code, Code::kDataLoss);
}

TEST(ElementMeshFile, HostileBytesGiveDataLossOrASoundMesh) {
  const Refined refined(box_with_sheet(), 14, 20);
  const std::vector<std::byte> bytes = encode(refined.mesh(one));
  // Up to 63 bytes behind the last array are padding.
  for (std::size_t size = 0; size + 64 <= bytes.size(); size += 1 + size / 64) {
    const Result<ElementMesh> cut = decode_element_mesh(std::span(bytes).first(size), refined.sides.count);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, Code::kDataLoss);
  }
  RandomSequence random(15);
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::byte> damaged = bytes;
    damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const Result<ElementMesh> mesh = decode_element_mesh(damaged, refined.sides.count);
    if (!mesh) continue;
    for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
      const Hit hit{0, triangle, random.uniform() / 2, random.uniform() / 2, 0};
      const ElementPoint at = locate(*mesh, refined.sides, refined.world.surfaces, hit, refined.world.surfaces.at(hit));
      EXPECT_TRUE(at.element == kNone || is_finite(interpolate(*mesh, at).direct));
    }
  }
}

}  // namespace
}  // namespace radfarm
