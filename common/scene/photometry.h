#pragma once

#include <vector>

#include "scene/scene.h"

namespace radfarm {

/// Directions in type C coordinates, degrees: gamma from the nadir; C around it, from the half-plane that holds the
/// light's `right`, counter-clockwise seen from above, that is against the way that the light shines. docs/sky.md

/// The table's intensity, cd, at gamma in [0, 180] and any C: bilinear, mirrored into the C that the table leaves out,
/// 0 at a gamma that it leaves out.
double candela_at(const Photometry& table, double gamma, double c);
/// The same in unit direction `way` from a light, whose direction is the nadir.
float candela(const Photometry& table, const Vec3& way, const PunctualLight& light);

/// Luminous flux, lm: zone after zone of gamma, with intensities linear between the table's angles, as candela_at() has
/// them.
double zonal_lumens(const Photometry& table);
float max_candela(const Photometry& table);

/// Chooses directions of a light: a cell between the table's angles, mirrored ones too, by the mean intensity of its
/// corners times its solid angle, then evenly over the solid angle. Above 0 wherever the table is.
class PhotometrySampler {
 public:
  PhotometrySampler() = default;
  explicit PhotometrySampler(const Photometry& table);

  struct Sample {
    Vec3 way{0, 0, -1};  // unit, from the light
    float pdf = 0;       // per steradian
  };
  /// u is uniform in [0, 1)^2. Requires: the table gives light.
  Sample sample(const Vec2& u, const PunctualLight& light) const;

 private:
  std::vector<float> gamma_;  // the table's
  std::vector<float> c_;      // all around
  std::vector<double> sums_;  // of the cells' weights, C by C for each gamma
};

}  // namespace radfarm
