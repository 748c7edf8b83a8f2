#include "radiosity/surfaces_of_patches.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/random.h"
#include "base/disjoint_sets.h"

namespace radfarm {
namespace {

constexpr float kLeastCosine = 0.906308F;  // of 25 degrees; 10 was as good in all scenes but one, docs/decisions/0020
// Where more sides than that meet at an edge, each is compared with so many before it.
constexpr std::size_t kMostCompared = 8;

using Place = std::array<std::uint32_t, 3>;

/// The bits of a position; -0 and 0 are one place.
Place place_of(const Vec3& p) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); };
  return {bits(p.x), bits(p.y), bits(p.z)};
}

/// An edge's ends from the smaller place to the larger one, and whether its side, seen counter-clockwise, goes that way.
struct Ends {
  Place low, high;
  bool is_upward;
};

Ends ends_of(const Patch& patch, std::uint32_t corner) {
  const Place a = place_of(patch.vertices[corner]), b = place_of(patch.vertices[(corner + 1) % 3]);
  return {std::min(a, b), std::max(a, b), a < b};
}

struct Edge {
  std::uint64_t key;  // of its ends: different edges may share one
  std::uint32_t patch, corner;
};

/// Whether one surface goes on over the edge: its sides go along it in opposite directions. The two outsides of a sheet that is folded
/// flat onto itself do not.
bool goes_on(const Patch& a, const Ends& at_a, const Patch& b, const Ends& at_b) {
  return a.instance == b.instance && at_a.low == at_b.low && at_a.high == at_b.high && at_a.is_upward != at_b.is_upward;
}

std::uint64_t key_of(std::uint32_t instance, const Ends& ends) {
  const auto& [low, high, is_upward] = ends;
  const auto both = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32U | b; };
  return combine(both(instance, low[0]), both(low[1], low[2]), both(high[0], high[1]), high[2]);
}

std::vector<Edge> sorted_edges(std::span<const Patch> patches) {
  std::vector<Edge> edges;
  edges.reserve(3 * patches.size());
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    if (!(area_of(patches[p].vertices) > 0)) continue;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Ends ends = ends_of(patches[p], corner);
      if (ends.low != ends.high) edges.push_back({key_of(patches[p].instance, ends), p, corner});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key != b.key ? a.key < b.key : a.patch < b.patch; });
  return edges;
}

/// Two sides that meet at an edge, and the cosine between their normals.
struct Fold {
  float cosine;
  std::uint32_t a, b;
};

std::vector<Fold> flattest_first(std::span<const Patch> patches) {
  const std::vector<Edge> edges = sorted_edges(patches);
  std::vector<Fold> folds;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i; j-- > 0 && i - j <= kMostCompared && edges[j].key == edges[i].key;) {
      const Patch& a = patches[edges[j].patch];
      const Patch& b = patches[edges[i].patch];
      const float cosine = dot(a.normal, b.normal);
      if (!(cosine > kLeastCosine) || !goes_on(a, ends_of(a, edges[j].corner), b, ends_of(b, edges[i].corner))) continue;
      folds.push_back({cosine, edges[j].patch, edges[i].patch});
    }
  }
  std::stable_sort(folds.begin(), folds.end(), [](const Fold& a, const Fold& b) { return a.cosine > b.cosine; });
  return folds;
}

bool is_flat(const Vec3d& a, const Vec3d& b) { return dot(a, b) > static_cast<double>(kLeastCosine) * length(a) * length(b); }

}  // namespace

std::vector<std::uint32_t> surfaces_of_patches(std::span<const Patch> patches) {
  DisjointSets sets(patches.size());
  std::vector<Vec3d> normals;  // of each set, at its root: summed by area
  normals.reserve(patches.size());
  for (const Patch& patch : patches) normals.push_back(to_double(patch.normal) * static_cast<double>(area_of(patch.vertices)));
  for (const Fold& fold : flattest_first(patches)) {
    const std::uint32_t a = sets.root(fold.a), b = sets.root(fold.b);
    if (a == b || !is_flat(normals[a], normals[b])) continue;
    sets.join(a, b);
    normals[std::min(a, b)] += normals[std::max(a, b)];
  }
  std::vector<std::uint32_t> surfaces(patches.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) surfaces[i] = sets.root(i) == i ? count++ : surfaces[sets.root(i)];
  return surfaces;
}

}  // namespace radfarm
