#include "math/sobol.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kFamilyLevel = 1e-6;
constexpr std::size_t kTests = 12;  // p-values that this file looks at
constexpr int kKeys = 200'000;

std::uint64_t key_of(int i) { return combine(91, static_cast<std::uint64_t>(i)); }

std::size_t cell_of(float x, std::size_t cells) { return static_cast<std::size_t>(x * static_cast<float>(cells)); }

TEST(SobolOwen, EveryAlignedBlockIsAZeroTwoNet) {
  for (int key = 0; key < 8; ++key) {
    for (std::uint32_t m = 0; m <= 10; ++m) {
      for (std::uint32_t block : {0U, 1U, 5U}) {
        for (std::uint32_t a = 0; a <= m; ++a) {
          const std::size_t columns = std::size_t{1} << a, rows = std::size_t{1} << (m - a);
          std::vector<int> hits(columns * rows);
          for (std::uint32_t i = 0; i < (1U << m); ++i) {
            const Vec2 p = sobol_owen_2d((block << m) + i, key_of(key));
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            ++hits[cell_of(p.y, rows) * columns + cell_of(p.x, columns)];
          }
          for (const int hit : hits) ASSERT_EQ(hit, 1) << "m " << m << " block " << block << " a " << a;
        }
      }
    }
  }
}

TEST(SobolOwen, OneDimensionIsStratifiedInEveryAlignedBlock) {
  for (std::uint32_t m = 0; m <= 12; ++m) {
    std::vector<int> hits(std::size_t{1} << m);
    for (std::uint32_t i = 0; i < (1U << m); ++i) ++hits[cell_of(sobol_owen_1d((3U << m) + i, 5), hits.size())];
    for (const int hit : hits) ASSERT_EQ(hit, 1);
  }
}

TEST(SobolOwen, EveryPointIsUniformOverTheKeys) {
  constexpr std::size_t kSide = 32;
  for (const std::uint32_t index : {0U, 1U, 2U, 37U, 4095U, 0xffffffffU}) {
    std::vector<double> observed(kSide * kSide);
    const std::vector<double> expected(kSide * kSide, static_cast<double>(kKeys) / (kSide * kSide));
    for (int key = 0; key < kKeys; ++key) {
      const Vec2 p = sobol_owen_2d(index, key_of(key));
      ++observed[cell_of(p.y, kSide) * kSide + cell_of(p.x, kSide)];
    }
    EXPECT_GT(test::chi_square(observed, expected).p_value, test::sidak_level(kFamilyLevel, kTests)) << index;
  }
}

// Under Owen's scrambling two points that agree in their first k binary digits are independent and uniform beyond digit
// k + 1; the shuffled pair (0, 1) differs in the first digit.
TEST(SobolOwen, NeighboursAreIndependentBeyondTheirStratum) {
  constexpr std::size_t kSide = 16;
  for (const bool second : {false, true}) {
    std::vector<double> observed(kSide * kSide), expected(kSide * kSide);
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
      const bool same_half = (i % kSide < kSide / 2) == (i / kSide < kSide / 2);
      expected[i] = same_half ? 0 : 2.0 * kKeys / (kSide * kSide);
    }
    for (int key = 0; key < kKeys; ++key) {
      const Vec2 p = sobol_owen_2d(0, key_of(key));
      const Vec2 q = sobol_owen_2d(1, key_of(key));
      ++observed[cell_of(second ? p.y : p.x, kSide) * kSide + cell_of(second ? q.y : q.x, kSide)];
    }
    EXPECT_GT(test::chi_square(observed, expected).p_value, test::sidak_level(kFamilyLevel, kTests));
  }
}

TEST(SobolOwen, DimensionsPaddedByKeyAreIndependent) {
  constexpr std::size_t kSide = 16;
  std::vector<double> observed(kSide * kSide);
  const std::vector<double> expected(kSide * kSide, static_cast<double>(kKeys) / (kSide * kSide));
  for (int key = 0; key < kKeys / 4; ++key) {
    // The same indices of both: a shared shuffle would tie the coordinates of the two pairs to each other.
    for (std::uint32_t index = 4; index < 8; ++index) {
      const float x = sobol_owen_2d(index, combine(key_of(key), 0)).x;
      const float y = sobol_owen_2d(index, combine(key_of(key), 1)).x;
      ++observed[cell_of(y, kSide) * kSide + cell_of(x, kSide)];
    }
  }
  // The four points of a key are stratified, so counts vary less than independent ones would: only an upper tail is wrong.
  EXPECT_GT(test::chi_square(observed, expected).p_value, test::sidak_level(kFamilyLevel, kTests));
}

TEST(SobolOwen, PrefixesAreUnbiasedAndConvergeFasterThanRandom) {
  // The integral of a smooth product over the square: mean (2/pi)^2, variance of one random point 1/4 - (2/pi)^4.
  constexpr double kMean = 4 / (M_PI * M_PI);
  const double random_variance = 0.25 - kMean * kMean;
  for (const std::uint32_t count : {3U, 64U, 1024U}) {
    RunningStatistics estimates;
    for (int key = 0; key < 1000; ++key) {
      double sum = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const Vec2 p = sobol_owen_2d(i, key_of(key));
        sum += std::sin(M_PI * static_cast<double>(p.x)) * std::sin(M_PI * static_cast<double>(p.y));
      }
      estimates.add(sum / count);
    }
    EXPECT_GT(test::z_test(estimates.mean(), estimates.standard_error(), kMean), test::sidak_level(kFamilyLevel, kTests));
    // Variance falls as n^-3 log n, random points' as n^-1: at least n times better holds from n = 64 with a wide margin.
    if (count < 64) continue;
    EXPECT_LT(estimates.variance(), random_variance / count / count);
  }
}

}  // namespace
}  // namespace radfarm
