#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace radfarm {

using Rgba8 = std::array<std::uint8_t, 4>;  // sRGB, as PNG has it

inline constexpr Rgba8 kNotANumber = {255, 0, 255, 255};  // magenta: nobody takes it for a value

/// From violet (0) by blue, teal and green to yellow (1): lightness grows evenly, so that the map reads in grey and to the colour
/// blind. Ten supports of viridis [van der Walt, Smith: A better default colormap for matplotlib, SciPy 2015; CC0], straight
/// lines between. Clamped; NaN gives kNotANumber.
Rgba8 viridis(float t);

/// A colour for a number that names something: neighbours differ, the same number always looks the same. Negative: black.
Rgba8 color_of_id(float id);

/// What the ends of a colour map stand for.
struct ValueRange {
  float low = 0;
  float high = 0;
  /// Where a value lies: 0 at `low`, 1 at `high`; 0 in a range without width.
  float place(float value) const { return high > low ? (value - low) / (high - low) : value - value; }
};

/// From the 1st to the 99th percentile of the finite values, so that single pixels do not decide; {} where there are none. O(n).
ValueRange robust_range(std::span<const float> values);

}  // namespace radfarm
