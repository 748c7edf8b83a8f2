#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace radfarm {

inline float blend(float a, float b, float share) { return a + (b - a) * share; }
inline void add_weighted(float& sum, float value, float weight) { sum += value * weight; }

/// A directional albedo over cosine x roughness, bilinear between entries that are dense where it changes most: at grazing, by the
/// cosine's root, and at small roughness, by its root above kLeast. T is what one entry holds; blend(T, T, share) is between two, add_weighted(T, T, weight) sums.
template <typename T>
class AlbedoTable {
 public:
  static constexpr std::size_t kCosines = 64;
  static constexpr std::size_t kRoughnesses = 32;
  static constexpr float kLeast = 0.03F;  // smoother facets are mirrors (kLeastAlpha)
  using Row = std::array<T, kCosines>;

  /// All cosines of one roughness: two rows and their share, looked up once.
  struct Curve {
    const Row* low = nullptr;
    const Row* high = nullptr;
    float share = 0;
    T mean{};  // cosine-weighted over the hemisphere

    T at(float cosine) const {
      const Place c = place(std::sqrt(std::clamp(cosine, 0.0F, 1.0F)), kCosines);
      return blend(blend((*low)[c.first], (*low)[c.first + 1], c.share),
                   blend((*high)[c.first], (*high)[c.first + 1], c.share), share);
    }
  };

  /// `integrate`(cosine, roughness) is an entry.
  template <typename Integrate>
  explicit AlbedoTable(const Integrate& integrate) {
    for (std::size_t r = 0; r < kRoughnesses; ++r) {
      const float roughness = roughness_of(r);
      for (std::size_t c = 0; c < kCosines; ++c) rows_[r][c] = integrate(cosine_of(c), roughness);
      means_[r] = mean_of(rows_[r]);
    }
  }

  Curve curve(float roughness) const {
    const Place r = place(std::sqrt(std::max(0.0F, roughness - kLeast) / (1 - kLeast)), kRoughnesses);
    return {&rows_[r.first], &rows_[r.first + 1], r.share, blend(means_[r.first], means_[r.first + 1], r.share)};
  }

 private:
  struct Place {
    std::size_t first = 0;
    float share = 0;  // of the one after `first`
  };

  static Place place(float t, std::size_t size) {
    const float x = std::clamp(t, 0.0F, 1.0F) * static_cast<float>(size - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(x), size - 2);
    return {first, x - static_cast<float>(first)};
  }

  static float roughness_of(std::size_t r) {
    const float root = static_cast<float>(r) / static_cast<float>(kRoughnesses - 1);
    return std::min(1.0F, kLeast + (1 - kLeast) * root * root);
  }

  static float cosine_of(std::size_t c) {
    const float root = std::max(static_cast<float>(c), 0.02F) / static_cast<float>(kCosines - 1);
    return std::min(1.0F, root * root);
  }

  /// 2 int g(mu) mu dmu = 4 int g t^3 dt over the root t of the cosine, the entries taken as linear between.
  static T mean_of(const Row& row) {
    constexpr std::size_t kParts = 4;
    constexpr float kStep = 1.0F / static_cast<float>((kCosines - 1) * kParts);
    T sum{};
    for (std::size_t k = 0; k < (kCosines - 1) * kParts; ++k) {
      const float begin = static_cast<float>(k) * kStep, end = begin + kStep;
      const float weight = end * end * end * end - begin * begin * begin * begin;  // they add up to 1
      const float share = (static_cast<float>(k % kParts) + 0.5F) / static_cast<float>(kParts);
      add_weighted(sum, blend(row[k / kParts], row[k / kParts + 1], share), weight);
    }
    return sum;
  }

  std::array<Row, kRoughnesses> rows_;
  std::array<T, kRoughnesses> means_;
};

}  // namespace radfarm
