#include "sharing/local_fit.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

// Added to each feature's own moment, as a share of the weights' sum: features are of order 1 across the window.
constexpr double kRidge = 1e-3;
constexpr int kTerms = LocalFits::kTerms;

using Matrix = std::array<std::array<double, kTerms>, kTerms>;

/// The first row of the inverse of a symmetric positive definite matrix: what each right side weighs in the constant term.
std::array<double, kTerms> first_row_of_inverse(Matrix m) {
  // L D L^T in place, below the diagonal L, on it D.
  for (int j = 0; j < kTerms; ++j) {
    for (int k = 0; k < j; ++k) m[j][j] -= m[j][k] * m[j][k] * m[k][k];
    for (int i = j + 1; i < kTerms; ++i) {
      for (int k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k] * m[k][k];
      m[i][j] /= m[j][j];
    }
  }
  std::array<double, kTerms> x{1};
  for (int i = 1; i < kTerms; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= m[i][k] * x[k];
  }
  for (int i = kTerms; i-- > 0;) {
    x[i] /= m[i][i];
    for (int k = i + 1; k < kTerms; ++k) x[i] -= m[k][i] * x[k];
  }
  return x;
}

}  // namespace

LocalFits::LocalFits(std::size_t lanes) : lanes_(lanes), moments_((kMoments + 3 * kTerms) * lanes) {}

void LocalFits::clear() { std::fill(moments_.begin(), moments_.end(), 0.0F); }

void LocalFits::add(std::size_t begin, std::size_t count, const float* weights, const std::array<const float*, 4>& features,
                    const std::array<const float*, 3>& values) {
  constexpr std::size_t kMost = 64;
  std::array<std::array<float, kMost>, kTerms> weighted;
  for (std::size_t first = 0; first < count; first += kMost) {
    const std::size_t n = std::min(kMost, count - first);
    float* row = moments_.data() + begin + first;
    const auto add_row = [&](const float* a, const float* b) {
      for (std::size_t i = 0; i < n; ++i) row[i] += a[i] * b[i];
      row += lanes_;
    };
    std::copy_n(weights + first, n, weighted[0].begin());
    for (int t = 1; t < kTerms; ++t) {
      const float* feature = features[t - 1] + first;
      for (std::size_t i = 0; i < n; ++i) weighted[t][i] = weighted[0][i] * feature[i];
    }
    for (std::size_t i = 0; i < n; ++i) row[i] += weighted[0][i];
    row += lanes_;
    for (int t = 1; t < kTerms; ++t) {
      for (std::size_t i = 0; i < n; ++i) row[i] += weighted[t][i];
      row += lanes_;
      for (int s = 1; s <= t; ++s) add_row(weighted[t].data(), features[s - 1] + first);
    }
    for (const float* value : values) {
      for (int t = 0; t < kTerms; ++t) add_row(weighted[t].data(), value + first);
    }
  }
}

std::array<double, 3> LocalFits::at_zero(std::size_t lane) const {
  const float* row = moments_.data() + lane;
  const auto next = [&] {
    const auto value = static_cast<double>(*row);
    row += lanes_;
    return value;
  };
  Matrix m{};
  for (int t = 0; t < kTerms; ++t) {
    for (int s = 0; s <= t; ++s) m[t][s] = m[s][t] = next();
  }
  for (int t = 1; t < kTerms; ++t) m[t][t] += kRidge * m[0][0];
  const std::array<double, kTerms> weigh = first_row_of_inverse(m);
  std::array<double, 3> fit{};
  for (double& channel : fit) {
    for (int t = 0; t < kTerms; ++t) channel += weigh[t] * next();
  }
  return fit;
}

}  // namespace radfarm
