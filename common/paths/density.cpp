#include "paths/density.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace radfarm {
namespace {

struct Query {
  Crossing& crossing;
  const Segment& segment;
  const SeeCrossings& see;
};

void cross(void* user, std::uint32_t disc) {
  const Query& query = *static_cast<Query*>(user);
  const CountedArea area = query.crossing.at(disc);
  if (area.whole > 0) query.see.crossing(query.segment, disc, area);
}

/// Sums of discs; of each, what one path brought is squared as a whole.
class Adder {
 public:
  explicit Adder(std::span<DiscSums> sums) : sums_(sums) {}

  void add(const Segment& segment, std::uint32_t disc, const CountedArea& area) {
    const SpectrumD power(segment.power);
    DiscSums& sums = sums_[disc];
    sums.flux += power * (1 / area.whole);
    if (area.inner > 0) sums.inner += luminance(power) / area.inner;
    ++sums.crossings;
    brought_.emplace_back(disc, luminance(power) / area.whole);
  }

  void end_path() {
    std::sort(brought_.begin(), brought_.end());
    for (std::size_t i = 0; i < brought_.size();) {
      const std::uint32_t disc = brought_[i].first;
      double light = 0;
      for (; i < brought_.size() && brought_[i].first == disc; ++i) light += brought_[i].second;
      sums_[disc].squared += light * light;
    }
    brought_.clear();
  }

 private:
  const std::span<DiscSums> sums_;
  std::vector<std::pair<std::uint32_t, double>> brought_;  // by the path so far
};

}  // namespace

PathLosses each_crossing(const World& world, const DiscSet& discs, OriginSet origins, const PathBatch& batch,
                         const SeeCrossings& see, const CrossingRules& rules) {
  const SeeSegment see_segment = [&](const Segment& segment) {
    if (!contains(origins, segment.origin)) return;
    Crossing crossing(world, discs, segment, rules);
    Query query{crossing, segment, see};
    discs.caster().crossed(segment.ray, segment.begin, crossing.far(), cross, &query);
  };
  return follow_batch(world, batch, see_segment, [&] {
    if (see.end_path) see.end_path();
  });
}

PathLosses add_batch(const World& world, const DiscSet& discs, OriginSet origins, const PathBatch& batch,
                     std::span<DiscSums> sums, const CrossingRules& rules) {
  Adder adder(sums);
  const SeeCrossings see{
      [&](const Segment& segment, std::uint32_t disc, const CountedArea& area) { adder.add(segment, disc, area); },
      [&] { adder.end_path(); }};
  return each_crossing(world, discs, origins, batch, see, rules);
}

double variance_of(const DiscSums& sums, double paths) {
  const double mean = luminance(sums.flux) / paths;
  return paths > 1 ? std::max(0.0, sums.squared / paths - mean * mean) / (paths - 1) : 0;
}

}  // namespace radfarm
