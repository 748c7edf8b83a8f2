#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/sampling.h"
#include "scene/latlong.h"
#include "scene/scene.h"
#include "scene/sky_patches.h"

namespace radfarm {

/// A part of the sky that gives light. The last patch is the sun when there is one; the others are of the map alone, so
/// that each bit of light is in one patch.
struct SkyPatch {
  Vec3 direction{0, 1, 0};  // unit, towards its light: mean by power
  Spectrum irradiance;      // integral of radiance over the patch: lux at normal incidence
  float solid_angle = 0;    // sr
  TexelRect texels;         // none: the sun
  float illuminance = 0;    // luminance of `irradiance`
  float radius = 0;         // of a cap of that solid angle, radians, about
};

/// The light of an Environment, and how to choose directions towards it: a patch with probability 0.9 by luminous
/// power, else by solid angle, then a texel by the light in its cell, then evenly over the cell's solid angle; the sun
/// evenly over its disc. Sums are doubles. Borrows the environment, which must stay where it is. Thread-safe once
/// built. Cost: O(texels) to build, with 8 bytes a texel; O(log texels) for a sample.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const Environment& environment);

  /// Whether no light comes from anywhere: no map or a black one, and no sun.
  bool is_empty() const { return patches_.empty(); }
  /// cd/m^2 from where `direction` (unit) points to: the map's, and the sun's inside its disc.
  Spectrum radiance(const Vec3& direction) const;

  struct Sample {
    Vec3 direction{0, 1, 0};  // unit, towards the light
    Spectrum radiance;        // cd/m^2
    float pdf = 0;            // per steradian
  };
  /// `choice` and `u` are uniform random numbers. Requires: !is_empty().
  Sample sample(double choice, const Vec2& u) const;
  /// Per steradian, with which sample() chooses `direction`; above 0 wherever radiance() is.
  float pdf(const Vec3& direction) const;

  std::span<const SkyPatch> patches() const { return patches_; }
  /// Discrete: with which sample() chooses a patch.
  double probability(std::uint32_t patch) const { return choice_.probability(patch); }
  bool has_sun() const { return has_sun_; }
  /// sample() of the map alone. Requires: a patch besides the sun.
  Sample sample_map(double choice, const Vec2& u) const;
  /// A direction to a patch, the radiance of this patch alone, and the density given the patch.
  Sample sample_patch(std::uint32_t patch, const Vec2& u) const;

  /// Integral of radiance over the sphere.
  Spectrum total() const { return Spectrum(total_); }
  /// cd/m^2 of the brightest texel, or of the sun before the map.
  float max_luminance() const { return max_luminance_; }

 private:
  struct Choice {
    LatLongMap::Texel texel;
    LatLong place;
  };
  void add_map();
  void add_patch(const TexelRect& rect, std::span<const Vec3d> meridians);
  void add_sun();
  void push_patch(SkyPatch patch, const SpectrumD& irradiance, double solid_angle);
  Choice choose_texel(const SkyPatch& patch, std::size_t first_row, const Vec2& u) const;
  Vec3 sample_sun(const Vec2& u) const;
  bool is_in_sun(const Vec3d& direction) const;
  bool is_sun(std::uint32_t patch) const { return has_sun_ && patch + 1 == patches_.size(); }
  double power_of(std::uint32_t patch) const;  // lm for each m^2 facing it
  double pdf_in_patch(std::uint32_t patch, const LatLongMap::Texel& texel) const;
  double pdf_of_map(const LatLongMap::Texel& texel) const;
  double pdf_of_sun() const;

  const Environment* environment_;
  std::optional<LatLongMap> map_;
  PatchTree tree_;
  std::vector<SkyPatch> patches_;
  std::vector<double> column_sums_;     // per texel: power of its row within its patch up to and with it
  std::vector<double> row_sums_;        // per row of each patch: power of the patch up to and with it
  std::vector<std::size_t> first_row_;  // per patch: into row_sums_
  DiscreteDistribution choice_;
  SpectrumD total_;
  float max_luminance_ = 0;
  bool has_sun_ = false;
  Vec3d sun_direction_{0, 1, 0};  // unit in double
  double sun_height_ = 0;         // of the disc's cap: 1 - cosine of its radius
};

}  // namespace radfarm
