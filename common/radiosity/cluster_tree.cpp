#include "radiosity/cluster_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "radiosity/cluster_split.h"
#include "radiosity/surfaces_of_patches.h"

namespace radfarm {
namespace {

constexpr std::size_t kReportedLeaves = 4096;  // are placed in some 10 ms

ClusterItem item_of(const Patch& patch, std::uint32_t id) {
  const TriangleVertices& v = patch.vertices;
  ClusterItem item;
  for (const Vec3& vertex : v) item.bounds.extendBy(vertex);
  item.centroid = (v[0] + v[1] + v[2]) / 3;
  item.normal = patch.normal;
  item.area = area_of(v);
  item.diameter = std::max({length(v[1] - v[0]), length(v[2] - v[1]), length(v[0] - v[2])});
  item.number = id;
  return item;
}

/// A surface as one item. Its mean normal is shorter the more it is bent.
ClusterItem item_of(std::span<const ClusterItem> sides, std::uint32_t id) {
  ClusterItem item = sides[0];
  item.number = id;
  if (sides.size() == 1) return item;
  Vec3d centroid(0, 0, 0), normal(0, 0, 0);
  double area = 0;
  for (const ClusterItem& side : sides) {
    const auto weight = static_cast<double>(side.area);
    item.bounds.extendBy(side.bounds);
    centroid += to_double(side.centroid) * weight;
    normal += to_double(side.normal) * weight;
    area += weight;
  }
  item.centroid = to_float(centroid / area);
  item.normal = to_float(normal / area);
  item.area = static_cast<float>(area);
  item.diameter = length(item.bounds.size());
  return item;
}

/// What is to be split: surfaces, and the sides of each in one run.
struct Items {
  std::vector<ClusterItem> surfaces;
  std::vector<ClusterItem> sides;
  std::vector<std::size_t> first_side;  // of each surface by its number; the number of sides last

  std::size_t sides_in(std::size_t begin, std::size_t end) const {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += first_side[surfaces[i].number + 1] - first_side[surfaces[i].number];
    return count;
  }
};

Items collect_items(const std::vector<Patch>& patches) {
  const std::vector<std::uint32_t> surface_of = surfaces_of_patches(patches);
  const std::uint32_t count = *std::max_element(surface_of.begin(), surface_of.end()) + 1;
  Items items;
  items.first_side.resize(count + 1);
  for (const std::uint32_t surface : surface_of) ++items.first_side[surface + 1];
  std::partial_sum(items.first_side.begin(), items.first_side.end(), items.first_side.begin());
  items.sides.resize(patches.size());
  std::vector<std::size_t> next = items.first_side;
  for (std::uint32_t p = 0; p < patches.size(); ++p) items.sides[next[surface_of[p]]++] = item_of(patches[p], p);
  items.surfaces.reserve(count);
  for (std::uint32_t s = 0; s < count; ++s) {
    const std::size_t first = items.first_side[s];
    items.surfaces.push_back(item_of(std::span(items.sides).subspan(first, items.first_side[s + 1] - first), s));
  }
  return items;
}

/// A node whose place is known, and the range of surfaces or, inside one surface, of sides below it.
struct Pending {
  std::uint32_t node;
  std::size_t begin, end;
  std::size_t first_leaf;
  int depth;
  bool is_inside;
};

/// A single surface goes on as its sides.
void enter(const Items& items, Pending& range) {
  if (range.is_inside || range.end - range.begin > 1) return;
  const std::uint32_t surface = items.surfaces[range.begin].number;
  range.begin = items.first_side[surface];
  range.end = items.first_side[surface + 1];
  range.is_inside = true;
}

void split(const Pending& range, Items& items, Hierarchy& hierarchy, std::vector<Pending>& pending) {
  std::vector<ClusterItem>& list = range.is_inside ? items.sides : items.surfaces;
  const std::size_t cut = range.begin + split_items(std::span(list).subspan(range.begin, range.end - range.begin), range.depth);
  const std::size_t leaves = range.is_inside ? cut - range.begin : items.sides_in(range.begin, cut);
  const auto child = static_cast<std::uint32_t>(hierarchy.nodes.size());
  hierarchy.nodes[range.node].first_child = child;
  hierarchy.nodes[range.node].child_count = 2;
  hierarchy.nodes.resize(hierarchy.nodes.size() + 2);
  hierarchy.nodes[child].parent = hierarchy.nodes[child + 1].parent = range.node;
  hierarchy.nodes[child].leaf_count = static_cast<std::uint32_t>(leaves);
  hierarchy.nodes[child + 1].leaf_count = hierarchy.nodes[range.node].leaf_count - hierarchy.nodes[child].leaf_count;
  pending.push_back({child, range.begin, cut, range.first_leaf, range.depth + 1, range.is_inside});
  pending.push_back({child + 1, cut, range.end, range.first_leaf + leaves, range.depth + 1, range.is_inside});
}

}  // namespace

void build_cluster_tree(Hierarchy& hierarchy, const Progress& progress) {
  Items items = collect_items(hierarchy.patches);
  std::size_t placed = 0;
  hierarchy.leaves.resize(items.sides.size());
  hierarchy.nodes.reserve(2 * items.sides.size() - 1);
  hierarchy.nodes.resize(1);
  hierarchy.nodes[0].leaf_count = static_cast<std::uint32_t>(items.sides.size());
  std::vector<Pending> pending = {{0, 0, items.surfaces.size(), 0, 0, false}};
  while (!pending.empty()) {
    Pending range = pending.back();
    pending.pop_back();
    enter(items, range);
    Node& node = hierarchy.nodes[range.node];
    node.first_leaf = static_cast<std::uint32_t>(range.first_leaf);
    if (node.leaf_count > 1) {
      split(range, items, hierarchy, pending);
      continue;
    }
    node.patch = items.sides[range.begin].number;
    hierarchy.leaves[range.first_leaf] = range.node;
    if (++placed % kReportedLeaves == 0) progress.report("radiosity: clusters", placed, items.sides.size());
  }
}

}  // namespace radfarm
