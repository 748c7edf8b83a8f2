#include "math/sobol.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

// The construction from direction numbers, for the second dimension's primitive polynomial x + 1.
std::uint32_t second_dimension_by_direction_numbers(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 0x80000000U; index != 0; index >>= 1, direction ^= direction >> 1) {
    if ((index & 1) != 0) result ^= direction;
  }
  return result;
}

TEST(Sobol, MatrixProductEqualsTheDirectionNumbers) {
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const std::uint32_t index = i * 2654435761U;
    EXPECT_EQ(sobol_detail::reverse_bits(sobol_detail::second_dimension_reversed(index)),
              second_dimension_by_direction_numbers(index));
  }
}

TEST(Sobol, ReversedBitsAreReversed) {
  EXPECT_EQ(sobol_detail::reverse_bits(1), 0x80000000U);
  EXPECT_EQ(sobol_detail::reverse_bits(0xf0000000U), 0xfU);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(sobol_detail::reverse_bits(sobol_detail::reverse_bits(i * 2654435761U)), i * 2654435761U);
  }
}

// Every image depends on these bits.
TEST(Sobol, PointsAreTheSameForever) {
  EXPECT_EQ(sobol_owen_2d(0, 0), Vec2(0x1.e8543p-1F, 0x1.111c52p-1F));
  EXPECT_EQ(sobol_owen_2d(1, 0), Vec2(0x1.83fb68p-3F, 0x1.242fb8p-3F));
  EXPECT_EQ(sobol_owen_2d(7, 42), Vec2(0x1.996d08p-2F, 0x1.b5a88cp-2F));
  EXPECT_EQ(sobol_owen_2d(1'000'000, ~0ULL), Vec2(0x1.f2469p-1F, 0x1.d5166cp-2F));
  EXPECT_EQ(sobol_owen_1d(7, 42), 0x1.996d08p-2F);
}

}  // namespace
}  // namespace radfarm
