#include "radiosity/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "math/sampling.h"
#include "radiosity/cluster_tree.h"
#include "scene/texture_uses.h"

namespace radfarm {
namespace {

// A side of a triangle is cut in so many for its mean: textures are averaged over each part, all else is taken at its middle.
constexpr int kLattice = 4;

/// Whether a mesh is the same all over: no texture, no vertex colours.
bool is_plain(const Scene& scene, std::uint32_t instance) {
  const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
  const auto uses = texture_uses(scene.materials[mesh.material]);
  return mesh.colors.empty() && std::all_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->texture == kNone; });
}

void average_material(const World& world, const Hit& corner, bool is_front, Patch& patch) {
  SpectrumD reflectance, emission;
  const int lattice = is_plain(world.scene, corner.instance) ? 1 : kLattice;
  const float size = 1.0F / static_cast<float>(lattice);
  int count = 0;
  for (int i = 0; i < lattice; ++i) {
    for (int j = 0; j < lattice - i; ++j) {
      Hit hit = corner;
      hit.u = (static_cast<float>(i) + 1.0F / 3) * size;
      hit.v = (static_cast<float>(j) + 1.0F / 3) * size;
      SurfacePoint point = world.surfaces.at_part(hit, size);
      point.is_front = is_front;
      const auto coverage = static_cast<double>(world.surfaces.coverage(hit));
      reflectance += coverage * SpectrumD(world.surfaces.reflectance(point));
      emission += coverage * SpectrumD(world.emission(point));
      ++count;
    }
  }
  patch.reflectance = Spectrum(reflectance / static_cast<double>(count));
  patch.emission = Spectrum(emission / static_cast<double>(count));
}

Patch make_patch(const World& world, std::uint32_t instance, std::uint32_t triangle, bool is_front) {
  Patch patch;
  const Hit hit{instance, triangle, 1.0F / 3, 1.0F / 3, 0};
  const SurfacePoint point = world.surfaces.at(hit);
  patch.vertices = world.surfaces.triangle(instance, triangle);
  patch.normal = is_front ? point.geometric_normal : -point.geometric_normal;
  if (!is_front) std::swap(patch.vertices[1], patch.vertices[2]);
  patch.offset = point.offset;
  patch.instance = instance;
  patch.triangle = triangle;
  patch.is_front = is_front ? 1 : 0;
  average_material(world, hit, is_front, patch);
  const Material& material = world.scene.materials[point.material];
  patch.is_textured_emitter = material.emission_texture.texture != kNone && !is_black(patch.emission) ? 1 : 0;
  return patch;
}

void fill_from_patch(const Patch& patch, Node& node) {
  for (const Vec3& v : patch.vertices) node.bounds.extendBy(v);
  node.cone_axis = patch.normal;
  node.cone_cosine = 1;
  node.area = area_of(patch.vertices);
  node.reflectance = patch.reflectance;
  node.emitted_power = patch.emission * (kPi * node.area);
}

/// The smallest cone around both children's cones, a little too wide rather than too narrow.
void merge_cones(const Node& a, const Node& b, Node& parent) {
  parent.cone_axis = normalize(a.cone_axis + b.cone_axis);
  parent.cone_cosine = -1;
  if (a.cone_cosine <= -1 || b.cone_cosine <= -1 || length(parent.cone_axis) < 0.5F) return;
  float widest = 0;
  for (const Node* child : {&a, &b}) {
    const float tilt = std::acos(std::clamp(dot(parent.cone_axis, child->cone_axis), -1.0F, 1.0F));
    widest = std::max(widest, tilt + std::acos(std::clamp(child->cone_cosine, -1.0F, 1.0F)));
  }
  parent.cone_cosine = widest + 1e-3F < kPi ? std::cos(widest + 1e-3F) : -1;
}

void fill_from_children(const Hierarchy& hierarchy, Node& node) {
  const Node& a = hierarchy.nodes[node.first_child];
  const Node& b = hierarchy.nodes[node.first_child + 1];
  node.bounds = a.bounds;
  node.bounds.extendBy(b.bounds);
  node.area = a.area + b.area;
  node.reflectance = (a.reflectance * a.area + b.reflectance * b.area) / node.area;
  node.emitted_power = a.emitted_power + b.emitted_power;
  merge_cones(a, b, node);
}

/// The part of a patch that a random number chooses by what it reflects, down to an undivided one. Uses up `choice`.
std::uint32_t choose_part(const Hierarchy& hierarchy, std::uint32_t id, double choice) {
  while (hierarchy.nodes[id].child_count > 0 && id < hierarchy.reflected.size() && hierarchy.reflected[id] > 0) {
    const Node& node = hierarchy.nodes[id];
    std::uint32_t part = node.first_child;
    if (part + node.child_count > hierarchy.reflected.size()) break;  // cut after the light was measured
    double left = choice * static_cast<double>(hierarchy.reflected[id]);
    while (part + 1 < node.first_child + node.child_count && left >= static_cast<double>(hierarchy.reflected[part])) {
      left -= static_cast<double>(hierarchy.reflected[part++]);
    }
    const auto power = static_cast<double>(hierarchy.reflected[part]);
    choice = power > 0 ? std::clamp(left / power, 0.0, 0x1.fffffffffffffp-1) : 0;
    id = part;
  }
  return id;
}

}  // namespace

float area_of(const TriangleVertices& v) {
  return static_cast<float>(length(cross(to_double(v[1]) - to_double(v[0]), to_double(v[2]) - to_double(v[0]))) / 2);
}

Hierarchy build_hierarchy(const World& world, const SideNumbers& sides, const std::vector<bool>& is_reachable,
                          const Progress& progress) {
  Hierarchy hierarchy;
  struct Source {
    std::uint32_t instance, triangle;
    bool is_front;
  };
  std::vector<Source> sources;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const std::size_t count = world.scene.meshes[world.scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < count; ++t) {
      for (const bool is_front : {true, false}) {
        if (is_reachable[sides.of(i, t, is_front)]) sources.push_back({i, t, is_front});
      }
    }
  }
  if (sources.empty()) return hierarchy;
  hierarchy.patches.resize(sources.size());
  parallel_for(progress, "radiosity: patches", sources.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      hierarchy.patches[i] = make_patch(world, sources[i].instance, sources[i].triangle, sources[i].is_front);
    }
  });
  if (progress.is_cancelled()) return {};
  progress.report("radiosity: clusters", 0, sources.size());
  build_cluster_tree(hierarchy, progress);
  for (std::size_t i = hierarchy.nodes.size(); i-- > 0;) {
    Node& node = hierarchy.nodes[i];
    node.is_cluster() ? fill_from_children(hierarchy, node) : fill_from_patch(hierarchy.patches[node.patch], node);
  }
  hierarchy.area_before = {0};
  hierarchy.emission_before = {0};
  for (const std::uint32_t leaf : hierarchy.leaves) {
    const Node& node = hierarchy.nodes[leaf];
    hierarchy.leaf_normals.push_back(hierarchy.patches[node.patch].normal);
    hierarchy.area_before.push_back(hierarchy.area_before.back() + static_cast<double>(node.area));
    hierarchy.emission_before.push_back(hierarchy.emission_before.back() + luminance(SpectrumD(node.emitted_power)));
  }
  return hierarchy;
}

std::uint32_t subdivide(Hierarchy& hierarchy, std::uint32_t node) {
  RADFARM_CHECK(!hierarchy.nodes[node].is_cluster() && hierarchy.nodes[node].child_count == 0);
  const auto first = static_cast<std::uint32_t>(hierarchy.nodes.size());
  const Patch whole = hierarchy.patches[hierarchy.nodes[node].patch];
  const auto& [a, b, c] = whole.vertices;
  const Vec3 ab = (a + b) * 0.5F, bc = (b + c) * 0.5F, ca = (c + a) * 0.5F;
  const TriangleVertices parts[4] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
  for (const TriangleVertices& vertices : parts) {
    Patch part = whole;
    part.vertices = vertices;
    Node child;
    child.parent = node;
    child.first_leaf = hierarchy.nodes[node].first_leaf;
    child.leaf_count = 1;
    child.patch = static_cast<std::uint32_t>(hierarchy.patches.size());
    fill_from_patch(part, child);
    hierarchy.patches.push_back(part);
    hierarchy.nodes.push_back(child);
  }
  hierarchy.nodes[node].first_child = first;
  hierarchy.nodes[node].child_count = 4;
  return first;
}

std::vector<std::uint32_t> nodes_of_sides(const SideNumbers& sides, const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> nodes(sides.count, kNone);
  for (const std::uint32_t leaf : hierarchy.leaves) {
    const Patch& patch = hierarchy.patches[hierarchy.nodes[leaf].patch];
    nodes[sides.of(patch.instance, patch.triangle, patch.is_front != 0)] = leaf;
  }
  return nodes;
}

PartPoint enter_part(double b, double c) {
  const double a = 1 - b - c;
  if (a > 0.5) return {0, 2 * b, 2 * c};
  if (b > 0.5) return {1, 2 * b - 1, 2 * c};
  if (c > 0.5) return {2, 2 * b, 2 * c - 1};
  return {3, 1 - 2 * a, 1 - 2 * (1 - a - c)};
}

std::uint32_t part_at(const Hierarchy& hierarchy, std::uint32_t node, const Vec3& position) {
  if (hierarchy.nodes[node].child_count == 0) return node;
  const TriangleVertices& v = hierarchy.patches[hierarchy.nodes[node].patch].vertices;
  const Vec3d e1 = to_double(v[1]) - to_double(v[0]), e2 = to_double(v[2]) - to_double(v[0]);
  const Vec3d d = to_double(position) - to_double(v[0]), normal = cross(e1, e2);
  double b = dot(cross(d, e2), normal) / dot(normal, normal);
  double c = dot(cross(e1, d), normal) / dot(normal, normal);
  while (hierarchy.nodes[node].child_count > 0) {
    const PartPoint inside = enter_part(b, c);
    b = inside.b;
    c = inside.c;
    node = hierarchy.nodes[node].first_child + inside.part;
  }
  return node;
}

void pull_up(const Hierarchy& hierarchy, std::vector<Spectrum>& power) {
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) power[hierarchy.nodes[i].parent] += power[i];
}

void set_reflected_power(Hierarchy& hierarchy, const std::vector<Spectrum>& power) {
  hierarchy.reflection_before = {0};
  for (const std::uint32_t leaf : hierarchy.leaves) {
    hierarchy.reflection_before.push_back(hierarchy.reflection_before.back() + luminance(SpectrumD(power[leaf])));
  }
  hierarchy.reflected.clear();
  for (const Spectrum& p : power) hierarchy.reflected.push_back(luminance(p));
}

NodeSample sample_node(const Hierarchy& hierarchy, const Node& node, SampleBy by, double choice, const Vec2& u) {
  std::uint32_t id = static_cast<std::uint32_t>(&node - hierarchy.nodes.data());
  if (node.is_cluster()) {
    const std::vector<double>& before = by == SampleBy::kArea            ? hierarchy.area_before
                                        : by == SampleBy::kEmittedPower ? hierarchy.emission_before
                                                                        : hierarchy.reflection_before;
    const double low = before[node.first_leaf], high = before[node.first_leaf + node.leaf_count];
    const auto begin = before.begin() + node.first_leaf + 1, end = begin + node.leaf_count - 1;
    // The last leaf takes what rounding leaves over; leaves of weight 0 are never chosen.
    const auto leaf = std::upper_bound(begin, end, low + choice * (high - low)) - before.begin() - 1;
    id = hierarchy.leaves[static_cast<std::size_t>(leaf)];
    const double below = before[static_cast<std::size_t>(leaf)], above = before[static_cast<std::size_t>(leaf) + 1];
    choice = above > below ? std::clamp((low + choice * (high - low) - below) / (above - below), 0.0, 1.0) : 0;
  }
  if (by == SampleBy::kReflectedPower) id = choose_part(hierarchy, id, choice);
  id = hierarchy.nodes[id].patch;
  const Patch& patch = hierarchy.patches[id];
  const Vec3 b = sample_uniform_triangle(u);
  const Vec3 position = patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z;
  return {position, patch.normal, patch.offset, id};
}

}  // namespace radfarm
