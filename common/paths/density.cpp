#include "paths/density.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kPathKey = 0x70686f746f6e;  // "photon"

/// Adds what segments bring; of each disc, what one path brought is squared as a whole.
class Adder {
 public:
  Adder(const World& world, const DiscSet& discs, OriginSet origins, std::span<DiscSums> sums, const CrossingRules& rules)
      : world_(world), discs_(discs), origins_(origins), sums_(sums), rules_(rules) {}

  void see(const Segment& segment) {
    if (!contains(origins_, segment.origin)) return;
    Crossing crossing(world_, discs_, segment, rules_);
    Query query{*this, segment, crossing};
    discs_.caster().crossed(segment.ray, segment.begin, crossing.far(), &Adder::cross, &query);
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
  struct Query {
    Adder& adder;
    const Segment& segment;
    Crossing& crossing;
  };

  static void cross(void* user, std::uint32_t disc) {
    const Query& query = *static_cast<Query*>(user);
    const CountedArea area = query.crossing.at(disc);
    if (!(area.whole > 0)) return;
    const SpectrumD power(query.segment.power);
    DiscSums& sums = query.adder.sums_[disc];
    sums.flux += power * (1 / area.whole);
    if (area.inner > 0) sums.inner += luminance(power) / area.inner;
    ++sums.crossings;
    query.adder.brought_.emplace_back(disc, luminance(power) / area.whole);
  }

  const World& world_;
  const DiscSet& discs_;
  const OriginSet origins_;
  const std::span<DiscSums> sums_;
  const CrossingRules& rules_;
  std::vector<std::pair<std::uint32_t, double>> brought_;  // by the path so far
};

}  // namespace

PathLosses add_batch(const World& world, const DiscSet& discs, OriginSet origins, const PathBatch& batch,
                     std::span<DiscSums> sums, const CrossingRules& rules) {
  Adder adder(world, discs, origins, sums, rules);
  const SeeSegment see = [&](const Segment& segment) { adder.see(segment); };
  const std::uint64_t key = combine(batch.seed, kPathKey, batch.batch);
  PathLosses losses;
  for (std::uint64_t i = 0; i < batch.paths; ++i) {
    const PathLosses one = follow_path(world, key, i, see);
    adder.end_path();
    losses.absorbed += one.absorbed;
    losses.escaped += one.escaped;
  }
  return losses;
}

double variance_of(const DiscSums& sums, double paths) {
  const double mean = luminance(sums.flux) / paths;
  return paths > 1 ? std::max(0.0, sums.squared / paths - mean * mean) / (paths - 1) : 0;
}

}  // namespace radfarm
