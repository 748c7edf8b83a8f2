#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/light_paths.h"

namespace radfarm {

/// How hits fell where a node's light is split among its children, held to the guess's shares p of sum 1.
struct Split {
  std::uint64_t hits = 0;  // N, of all children
  double scatter = 0;      // sum over children of (n - N p)^2 / N
  double spread = 0;       // q = 1 - sum p^2: the mean of `scatter` if the guess is right; N q if it says nothing
};
Split make_split(std::span<const double> shares, std::span<const std::uint32_t> hits);

/// How far the guess can be trusted at a split: as much as so many hits.               docs/pipeline.md (radiosity.7)
///
/// Were the guess right, n hits of N in a child of share p would scatter about N p as a binomial; guesses whose shares have a
/// beta distribution of mean p and weight K scatter (N + K) / (K + 1) times as much. K follows by the first moment from all
/// splits of about as many hits and from the split itself, which counts twice as much: guesses are wrong in places.
class GuessTrust {
 public:
  GuessTrust();
  void learn(const Split& split);
  /// K, in [1/16, 65536].
  double weight(const Split& split) const;

 private:
  struct Evidence {
    double scatter = 0, least = 0, most = 0;  // sums of scatter, q and N q
    double splits = 0;
  };
  std::array<Evidence, 32> classes_;  // by powers of two of the hits
};

/// The power that undivided patches reflect of light that other surfaces sent (one a node, lm), from what paths found and from
/// `guess` (one a node, lm). All keep the power found; from the root down each node's is split among its children by
/// (K p + N f) / (K + N): p the guess's share, f the share that the N hits brought, K the GuessTrust. O(nodes).
std::vector<Spectrum> combine_with_guess(const Hierarchy& hierarchy, const PathHits& hits, const std::vector<Spectrum>& guess);

}  // namespace radfarm
