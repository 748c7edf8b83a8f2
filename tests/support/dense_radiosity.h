#pragma once

#include <vector>

#include "math/vec.h"

namespace radfarm::test {

/// One flat surface that sends the same light everywhere.
struct DenseElement {
  std::vector<Vec3d> corners;  // convex, counter-clockwise seen from the lit side
  double reflectance = 0;
  double exitance = 0;         // pi L_e
};

double area_of(const DenseElement& element);

/// Mean over `from` of the share of its light that `to` receive. Nothing may hide them. Error: that of a mean over 2 x `cells`^2 points.
double form_factor(const DenseElement& from, const std::vector<DenseElement>& to, int cells);

/// Radiosity of each element: (I - rho F) B = E in double, by Gauss-Seidel to 1e-12. Rows of F are means of Lambert's exact point
/// form factor over `cells`^2 points a triangle of the receiver. Nothing may hide anything: for scenes that are convex or open.
/// What is left of error is the assumption of uniform elements, and that mean. O(elements^2 cells^2), 0.1 us a point and edge.
std::vector<double> dense_radiosity(const std::vector<DenseElement>& elements, int cells);

}  // namespace radfarm::test
