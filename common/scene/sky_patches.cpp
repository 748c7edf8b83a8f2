#include "scene/sky_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

namespace radfarm {
namespace {

constexpr double kWidest = 12.0 / 180 * std::numbers::pi;  // radians: a band of Tregenza's 145 patches
constexpr double kLargestShare = 1.0 / 256;                // of the map's power in a patch of several texels

}  // namespace

class PatchCutter {
 public:
  PatchCutter(const LatLongMap& map, std::span<const double> power, PatchTree& tree)
      : map_(map), power_(power), tree_(tree) {}

  void cut() {
    tree_.nodes_.push_back({});
    halve(0, {0, map_.height(), 0, map_.width()});
    double total = 0;
    for (const Leaf& leaf : leaves_) total += leaf.power;
    std::priority_queue<Leaf> brightest(std::less<Leaf>(), std::move(leaves_));
    while (!brightest.empty() && brightest.top().power > 0) {
      const Leaf leaf = brightest.top();
      brightest.pop();
      if (leaf.power > kLargestShare * total && !is_texel(leaf.rect)) {
        const auto [first, second] = split(leaf.node, leaf.rect, across_rows(leaf.rect), Where::kMedian);
        brightest.push(first);
        brightest.push(second);
        continue;
      }
      tree_.nodes_[leaf.node].children = static_cast<std::uint32_t>(tree_.rects_.size());
      tree_.rects_.push_back(leaf.rect);
    }
  }

 private:
  enum class Where { kMiddle, kMedian };
  struct Leaf {
    double power = 0;
    std::uint32_t node = 0;
    TexelRect rect;
    // Of equal power the first made comes first: the order is the same everywhere.
    bool operator<(const Leaf& other) const { return std::pair(power, other.node) < std::pair(other.power, node); }
  };

  static bool is_texel(const TexelRect& r) {
    return r.row_end - r.row_begin == 1 && r.column_end - r.column_begin == 1;
  }
  double tall(const TexelRect& r) const { return std::numbers::pi * (r.row_end - r.row_begin) / map_.height(); }
  /// Where the rectangle is widest.
  double wide(const TexelRect& r) const {
    const double step = std::numbers::pi / map_.height();
    const double nearest = std::clamp(std::numbers::pi / 2, r.row_begin * step, r.row_end * step);
    return 2 * std::numbers::pi * (r.column_end - r.column_begin) / map_.width() * std::sin(nearest);
  }
  bool across_rows(const TexelRect& r) const {
    if (r.row_end - r.row_begin == 1) return false;
    return r.column_end - r.column_begin == 1 || tall(r) >= wide(r);
  }

  void halve(std::uint32_t node, const TexelRect& rect) {
    const bool too_tall = tall(rect) > kWidest && rect.row_end - rect.row_begin > 1;
    const bool too_wide = wide(rect) > kWidest && rect.column_end - rect.column_begin > 1;
    if (!too_tall && !too_wide) {
      leaves_.push_back({power_of(rect), node, rect});
      return;
    }
    const auto [first, second] = split(node, rect, too_tall, Where::kMiddle);
    halve(first.node, first.rect);
    halve(second.node, second.rect);
  }

  std::pair<Leaf, Leaf> split(std::uint32_t node, const TexelRect& rect, bool by_row, Where where) {
    const std::uint32_t begin = by_row ? rect.row_begin : rect.column_begin,
                        end = by_row ? rect.row_end : rect.column_end;
    const std::uint32_t cut = where == Where::kMiddle ? begin + (end - begin) / 2 : median(rect, by_row);
    const auto children = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_[node] = {by_row, cut, children};
    tree_.nodes_.resize(tree_.nodes_.size() + 2);
    Leaf first{0, children, rect}, second{0, children + 1, rect};
    (by_row ? first.rect.row_end : first.rect.column_end) = cut;
    (by_row ? second.rect.row_begin : second.rect.column_begin) = cut;
    if (where == Where::kMedian) first.power = power_of(first.rect), second.power = power_of(second.rect);
    return {first, second};
  }

  /// The row or column before which as near as possible to half of the power lies; never an end.
  std::uint32_t median(const TexelRect& rect, bool by_row) const {
    const std::uint32_t begin = by_row ? rect.row_begin : rect.column_begin,
                        end = by_row ? rect.row_end : rect.column_end;
    const double half = power_of(rect) / 2;
    double sum = 0;
    for (std::uint32_t i = begin; i + 1 < end; ++i) {
      TexelRect line = rect;
      (by_row ? line.row_begin : line.column_begin) = i;
      (by_row ? line.row_end : line.column_end) = i + 1;
      const double power = power_of(line);
      if (sum + power / 2 >= half && i > begin) return i;
      sum += power;
      if (sum >= half) return i + 1;
    }
    return end - 1;
  }

  double power_of(const TexelRect& r) const {
    double sum = 0;
    for (std::uint32_t row = r.row_begin; row < r.row_end; ++row) {
      for (std::uint32_t c = r.column_begin; c < r.column_end; ++c) sum += power_[std::size_t{row} * map_.width() + c];
    }
    return sum;
  }

  const LatLongMap& map_;
  std::span<const double> power_;
  PatchTree& tree_;
  std::vector<Leaf> leaves_;
};

PatchTree::PatchTree(const LatLongMap& map, std::span<const double> power) { PatchCutter(map, power, *this).cut(); }

std::uint32_t PatchTree::find(const LatLongMap::Texel& texel) const {
  std::uint32_t node = 0;
  while (nodes_[node].cut != 0) {
    const bool is_second = (nodes_[node].by_row ? texel.row : texel.column) >= nodes_[node].cut;
    node = nodes_[node].children + (is_second ? 1 : 0);
  }
  return nodes_[node].children;
}

}  // namespace radfarm
