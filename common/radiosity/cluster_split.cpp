#include "radiosity/cluster_split.h"

#include <algorithm>
#include <array>
#include <limits>

namespace radfarm {
namespace {

// An item longer than this share of its group's diagonal is split off before the rest is grouped.
constexpr float kLargeShare = 0.3F;
// Weight of orientation against place when groups are split: opposite normals are as far apart as this many diagonals.
constexpr float kNormalWeight = 0.35F;
constexpr std::size_t kBins = 32;
// Uneven cuts may nest: below this depth, where 2^32 items would fit if all were even, cuts are at the median.
constexpr int kMaxUnevenDepth = 32;

using Key = std::array<float, 6>;

Key key_of(const ClusterItem& item, float normal_scale) {
  const Vec3 n = item.normal * normal_scale;
  return {item.centroid.x, item.centroid.y, item.centroid.z, n.x, n.y, n.z};
}

/// Area-weighted sums along one coordinate.
struct Moments {
  double weight = 0, sum = 0, squares = 0;

  void add(double w, double x) { weight += w, sum += w * x, squares += w * x * x; }
  void add(const Moments& other) { weight += other.weight, sum += other.sum, squares += other.squares; }
  /// The weighted sum of squared distances to the mean.
  double spread() const { return weight > 0 ? std::max(0.0, squares - sum * sum / weight) : 0; }
};

struct Extent {
  Key low, high;
  std::size_t axis = 0;  // along which the items vary most
};

/// About the middle of the group, so that squares keep their digits.
Extent measure(std::span<const ClusterItem> items, float normal_scale) {
  Extent extent;
  extent.low.fill(std::numeric_limits<float>::infinity());
  extent.high.fill(-std::numeric_limits<float>::infinity());
  for (const ClusterItem& item : items) {
    const Key key = key_of(item, normal_scale);
    for (std::size_t k = 0; k < key.size(); ++k) {
      extent.low[k] = std::min(extent.low[k], key[k]), extent.high[k] = std::max(extent.high[k], key[k]);
    }
  }
  std::array<Moments, 6> moments;
  for (const ClusterItem& item : items) {
    const Key key = key_of(item, normal_scale);
    for (std::size_t k = 0; k < key.size(); ++k) {
      moments[k].add(static_cast<double>(item.area), static_cast<double>(key[k] - (extent.low[k] + extent.high[k]) / 2));
    }
  }
  for (std::size_t k = 1; k < moments.size(); ++k) {
    if (moments[k].spread() > moments[extent.axis].spread()) extent.axis = k;
  }
  return extent;
}

std::size_t bin_of(float key, float low, float high) {
  const auto bin = static_cast<std::size_t>((key - low) / (high - low) * static_cast<float>(kBins));
  return std::min(bin, kBins - 1);
}

/// The bin before which to cut so that the two parts spread least in sum.
std::size_t best_cut(std::span<const ClusterItem> items, float normal_scale, const Extent& extent) {
  const float low = extent.low[extent.axis], high = extent.high[extent.axis];
  std::array<Moments, kBins> bins;
  for (const ClusterItem& item : items) {
    const float key = key_of(item, normal_scale)[extent.axis];
    bins[bin_of(key, low, high)].add(static_cast<double>(item.area), static_cast<double>(key - (low + high) / 2));
  }
  std::array<double, kBins> above{};
  Moments right, left;
  for (std::size_t b = kBins; b-- > 1;) right.add(bins[b]), above[b] = right.spread();
  std::size_t best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 1; b < kBins; ++b) {
    left.add(bins[b - 1]);
    const double both = left.spread() + above[b];
    if (both < least) least = both, best = b;
  }
  return best;
}

std::size_t median(std::span<ClusterItem> items, float normal_scale, std::size_t axis) {
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const ClusterItem& a, const ClusterItem& b) {
                     const float ka = key_of(a, normal_scale)[axis], kb = key_of(b, normal_scale)[axis];
                     return ka != kb ? ka < kb : a.number < b.number;
                   });
  return half;
}

}  // namespace

std::size_t split_items(std::span<ClusterItem> items, int depth) {
  Box3 box;
  float mean_diameter = 0;
  for (const ClusterItem& item : items) {
    box.extendBy(item.bounds);
    mean_diameter += item.diameter / static_cast<float>(items.size());
  }
  const float large = kLargeShare * length(box.size());
  const auto middle = std::stable_partition(items.begin(), items.end(), [&](const ClusterItem& i) { return i.diameter > large; });
  if (middle != items.begin() && middle != items.end()) return static_cast<std::size_t>(middle - items.begin());

  const float normal_scale = kNormalWeight * std::max(length(box.size()), mean_diameter);
  const Extent extent = measure(items, normal_scale);
  const float low = extent.low[extent.axis], high = extent.high[extent.axis];
  if (depth > kMaxUnevenDepth || !(high > low)) return median(items, normal_scale, extent.axis);
  const std::size_t cut = best_cut(items, normal_scale, extent);
  const auto right = std::stable_partition(items.begin(), items.end(), [&](const ClusterItem& item) {
    return bin_of(key_of(item, normal_scale)[extent.axis], low, high) < cut;
  });
  const auto first = static_cast<std::size_t>(right - items.begin());
  return first > 0 && first < items.size() ? first : median(items, normal_scale, extent.axis);
}

}  // namespace radfarm
