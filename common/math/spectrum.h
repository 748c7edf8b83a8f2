#pragma once

#include <algorithm>
#include <cmath>

namespace radfarm {

/// Light or reflectance in three channels, linear Rec.709. Photometric: luminance() of radiance is cd/m^2, of irradiance lux.
template <typename T>
struct BasicSpectrum {
  T r = 0, g = 0, b = 0;

  constexpr BasicSpectrum() = default;
  constexpr BasicSpectrum(T red, T green, T blue) : r(red), g(green), b(blue) {}
  constexpr explicit BasicSpectrum(T grey) : r(grey), g(grey), b(grey) {}
  template <typename U>
  constexpr explicit BasicSpectrum(const BasicSpectrum<U>& other)
      : r(static_cast<T>(other.r)), g(static_cast<T>(other.g)), b(static_cast<T>(other.b)) {}

  constexpr BasicSpectrum& operator+=(const BasicSpectrum& o) { return *this = *this + o; }
  constexpr BasicSpectrum& operator-=(const BasicSpectrum& o) { return *this = *this - o; }
  constexpr BasicSpectrum& operator*=(const BasicSpectrum& o) { return *this = *this * o; }
  constexpr BasicSpectrum& operator*=(T s) { return *this = *this * s; }

  friend constexpr BasicSpectrum operator+(const BasicSpectrum& a, const BasicSpectrum& b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
  }
  friend constexpr BasicSpectrum operator-(const BasicSpectrum& a, const BasicSpectrum& b) {
    return {a.r - b.r, a.g - b.g, a.b - b.b};
  }
  friend constexpr BasicSpectrum operator*(const BasicSpectrum& a, const BasicSpectrum& b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
  }
  friend constexpr BasicSpectrum operator*(const BasicSpectrum& a, T s) { return {a.r * s, a.g * s, a.b * s}; }
  friend constexpr BasicSpectrum operator*(T s, const BasicSpectrum& a) { return a * s; }
  friend constexpr BasicSpectrum operator/(const BasicSpectrum& a, T s) { return {a.r / s, a.g / s, a.b / s}; }
  friend constexpr bool operator==(const BasicSpectrum&, const BasicSpectrum&) = default;
};

using Spectrum = BasicSpectrum<float>;
/// For sums over more than 1e4 terms, hierarchies and energies.
using SpectrumD = BasicSpectrum<double>;

template <typename T>
constexpr T luminance(const BasicSpectrum<T>& s) {
  return static_cast<T>(0.2126) * s.r + static_cast<T>(0.7152) * s.g + static_cast<T>(0.0722) * s.b;
}
template <typename T>
constexpr T max_component(const BasicSpectrum<T>& s) {
  return std::max(s.r, std::max(s.g, s.b));
}
template <typename T>
constexpr T min_component(const BasicSpectrum<T>& s) {
  return std::min(s.r, std::min(s.g, s.b));
}
template <typename T>
constexpr bool is_black(const BasicSpectrum<T>& s) {
  return s.r == 0 && s.g == 0 && s.b == 0;
}
template <typename T>
bool is_finite(const BasicSpectrum<T>& s) {
  return std::isfinite(s.r) && std::isfinite(s.g) && std::isfinite(s.b);
}

}  // namespace radfarm
