#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace radfarm {

/// Weighted least-squares fits of linear functions of four features, one a pixel of a row of `lanes`: normal equations by terms,
/// so that additions run over pixels. Three channels share the weights.
class LocalFits {
 public:
  static constexpr int kTerms = 5;  // 1 and the features
  explicit LocalFits(std::size_t lanes);

  void clear();
  /// Adds one neighbour to each lane of [begin, begin + count): `weights`, `features` and `values` are rows of `count`.
  void add(std::size_t begin, std::size_t count, const float* weights, const std::array<const float*, 4>& features,
           const std::array<const float*, 3>& values);
  /// The fit at features of zero; features are held back a little, so that what they do not vary in stays 0.
  /// Requires: a neighbour of positive weight.
  std::array<double, 3> at_zero(std::size_t lane) const;

 private:
  static constexpr int kMoments = kTerms * (kTerms + 1) / 2;
  std::size_t lanes_;
  std::vector<float> moments_;  // kMoments rows, then 3 * kTerms rows
};

}  // namespace radfarm
