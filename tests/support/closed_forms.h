#pragma once

#include <cmath>
#include <numbers>

namespace radfarm::test {

/// Form factors and radiosities with closed forms, in double. O1 to O13: ALGORITHMS.md 3.1.

/// O1: between equal rectangles a x b, parallel, `gap` apart. Cancels where the gap is large: 1e-7 relative at a / gap = 0.01.
inline double parallel_rectangles(double a, double b, double gap) {
  const double x = a / gap, y = b / gap, rx = std::hypot(1, x), ry = std::hypot(1, y);
  return 2 / (std::numbers::pi * x * y) *
         (std::log1p(x * x * y * y / (1 + x * x + y * y)) / 2 + x * ry * std::atan(x / ry) + y * rx * std::atan(y / rx) -
          x * std::atan(x) - y * std::atan(y));
}

/// O2: from a floor of width w to a wall of height h; they share an edge of length l at a right angle.
inline double perpendicular_rectangles(double w, double h, double l) {
  w /= l, h /= l;
  const double ww = w * w, hh = h * h, r = std::hypot(w, h);
  return (w * std::atan(1 / w) + h * std::atan(1 / h) - r * std::atan(1 / r) +
          (std::log((1 + ww) * (1 + hh) / (1 + ww + hh)) + ww * std::log(ww * (1 + ww + hh) / ((1 + ww) * (ww + hh))) +
           hh * std::log(hh * (1 + hh + ww) / ((1 + hh) * (hh + ww)))) / 4) /
         (std::numbers::pi * w);
}

/// O3: from the disc r1 to the disc r2 on the same axis, `gap` apart; the form without cancellation.
inline double coaxial_discs(double r1, double r2, double gap) {
  const double a = r1 / gap, b = r2 / gap, s = 1 + (1 + b * b) / (a * a), q = b / a * (b / a);
  return 2 * q / (s + std::sqrt((s - 2 * b / a) * (s + 2 * b / a)));
}

/// Radiosity of two surfaces of which each is uniform: B = E + rho F B. O11 to O13 and every two-element system of O19.
struct TwoSurfaces {
  double b1 = 0;
  double b2 = 0;
};
inline TwoSurfaces two_surfaces(double e1, double e2, double rho1, double rho2, const double (&f)[2][2]) {
  const double a = 1 - rho1 * f[0][0], b = -rho1 * f[0][1], c = -rho2 * f[1][0], d = 1 - rho2 * f[1][1];
  const double det = a * d - b * c;
  return {(e1 * d - b * e2) / det, (a * e2 - c * e1) / det};
}

/// O12 and O11: a convex surface 1 that a closed one, 2, surrounds: F12 = 1, F21 = A1 / A2, whatever their shapes.
inline TwoSurfaces surrounded(double e1, double e2, double rho1, double rho2, double area1, double area2) {
  const double share = area1 / area2;
  return two_surfaces(e1, e2, rho1, rho2, {{0, 1}, {share, 1 - share}});
}

}  // namespace radfarm::test
