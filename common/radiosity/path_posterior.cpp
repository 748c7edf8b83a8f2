#include "radiosity/path_posterior.h"

#include <algorithm>
#include <bit>

namespace radfarm {
namespace {

constexpr double kLeastWeight = 1.0 / 16, kMostWeight = 65536;
// What is believed before any split is seen: K = 1, as firmly as so many splits in two halves would say.
constexpr double kPriorSplits = 4;
// All others of its class say of a split as much as so many of it: guesses are wrong in places. Of 1/4 to 4, docs/decisions/0017.
constexpr double kClassSplits = 0.5;

/// Hits and power of all that lies below each node.
struct Sums {
  std::vector<std::uint32_t> count;
  std::vector<SpectrumD> found;
  std::vector<SpectrumD> likely;
};

void pull_up(const Hierarchy& hierarchy, Sums& sums) {
  for (std::size_t i = hierarchy.nodes.size(); i-- > 1;) {
    const std::uint32_t parent = hierarchy.nodes[i].parent;
    sums.count[parent] += sums.count[i];
    sums.found[parent] += sums.found[i];
    sums.likely[parent] += sums.likely[i];
  }
}

/// What each node with children tells of the guess.
std::vector<Split> make_splits(const Hierarchy& hierarchy, const Sums& sums) {
  std::vector<Split> splits(hierarchy.nodes.size());
  std::array<double, 4> shares{};
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    const double whole = luminance(sums.likely[i]);
    if (node.child_count == 0 || !(whole > 0)) continue;
    for (std::uint32_t c = 0; c < node.child_count; ++c) shares[c] = luminance(sums.likely[node.first_child + c]) / whole;
    splits[i] = make_split(std::span(shares).first(node.child_count),
                           std::span(sums.count).subspan(node.first_child, node.child_count));
  }
  return splits;
}

std::size_t class_of(std::uint64_t hits) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::bit_width(hits)), 1, 32) - 1;
}

/// A channel's share of a child, of what is likely and what was found there and below its parent.
double share(double likely, double likely_whole, double found, double found_whole, double weight, double hits) {
  if (!(likely_whole > 0)) return found_whole > 0 ? found / found_whole : 0;  // links left dark what paths met
  const double p = likely / likely_whole;
  return found_whole > 0 ? (weight * p + hits * found / found_whole) / (weight + hits) : p;
}

}  // namespace

GuessTrust::GuessTrust() {
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const double hits = 1.5 * static_cast<double>(std::uint64_t{1} << i);
    classes_[i] = {kPriorSplits * (hits + 1) / 4, kPriorSplits / 2, kPriorSplits * hits / 2, kPriorSplits};
  }
}

void GuessTrust::learn(const Split& split) {
  if (split.hits < 2) return;  // one hit scatters as much under any K
  Evidence& evidence = classes_[class_of(split.hits)];
  evidence.scatter += split.scatter;
  evidence.least += split.spread;
  evidence.most += static_cast<double>(split.hits) * split.spread;
  evidence.splits += 1;
}

double GuessTrust::weight(const Split& split) const {
  const Evidence& e = classes_[class_of(split.hits)];
  const double own = e.splits / kClassSplits;
  const double scatter = e.scatter + own * split.scatter, least = e.least + own * split.spread;
  const double most = e.most + own * static_cast<double>(split.hits) * split.spread;
  if (scatter <= least) return kMostWeight;
  return std::clamp((most - scatter) / (scatter - least), kLeastWeight, kMostWeight);
}

Split make_split(std::span<const double> shares, std::span<const std::uint32_t> hits) {
  Split split;
  for (const std::uint32_t n : hits) split.hits += n;
  const auto all = static_cast<double>(split.hits);
  split.spread = 1;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const double off = hits[c] - all * shares[c];
    split.scatter += all > 0 ? off * off / all : 0;
    split.spread -= shares[c] * shares[c];
  }
  return split;
}

std::vector<Spectrum> combine_with_guess(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& guess) {
  std::vector<Spectrum> power(hierarchy.nodes.size());
  if (power.empty()) return power;
  Sums sums{hits.count, hits.reflected, {}};
  for (std::size_t i = 0; i < guess.size(); ++i) {
    sums.likely.push_back(hierarchy.nodes[i].child_count == 0 ? SpectrumD(guess[i]) : SpectrumD());
  }
  pull_up(hierarchy, sums);
  const std::vector<Split> splits = make_splits(hierarchy, sums);
  std::array<GuessTrust, 2> trust;  // links share a cluster's light among its patches otherwise than a patch's among its parts
  for (std::size_t i = 0; i < splits.size(); ++i) trust[hierarchy.nodes[i].is_cluster() ? 0 : 1].learn(splits[i]);
  std::vector<SpectrumD> shared(power.size());
  shared[0] = sums.found[0];
  for (std::uint32_t i = 0; i < power.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (node.child_count == 0) power[i] = Spectrum(shared[i]);
    const double weight = trust[node.is_cluster() ? 0 : 1].weight(splits[i]), n = sums.count[i];
    const SpectrumD& all_likely = sums.likely[i];
    const SpectrumD& all_found = sums.found[i];
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      const SpectrumD& likely = sums.likely[c];
      const SpectrumD& found = sums.found[c];
      shared[c] = shared[i] * SpectrumD(share(likely.r, all_likely.r, found.r, all_found.r, weight, n),
                                        share(likely.g, all_likely.g, found.g, all_found.g, weight, n),
                                        share(likely.b, all_likely.b, found.b, all_found.b, weight, n));
    }
  }
  return power;
}

}  // namespace radfarm
