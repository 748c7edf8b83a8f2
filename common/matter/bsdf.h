#pragma once

#include <array>

#include "math/spectrum.h"
#include "math/vec.h"
#include "matter/ggx.h"
#include "matter/layers.h"
#include "matter/matter.h"

namespace radfarm {

/// How matter scatters the light of one direction at one point: f(o, i) of DESIGN 3 in two parts, which the light partition keeps
/// apart. The diffuse part is Lambertian but for what the layers above it let through; the specular part has all other lobes.
/// Radiance in a medium is divided by the square of its index. Directions are unit, in the world, away from the surface; one is
/// `above` when it lies on the viewer's side of the shading normal.                     docs/materials.md (matter.1) to (matter.5)
class Bsdf {
 public:
  /// `frame`: z along the shading normal, on the viewer's side; x along the tangent. `is_front`: the viewer is outside a volume.
  Bsdf(const Matter& matter, const Frame& frame, const Vec3& to_viewer, bool is_front);

  bool has_diffuse() const { return !is_black(diffuse_); }
  bool has_specular() const { return has_specular_; }
  /// Whether every direction that it scatters to is one of a few: no other light can be weighed by a density.
  bool is_delta() const { return !has_diffuse() && is_delta_; }
  /// Whether light from below reaches the viewer, delta lobes left out.
  bool transmits() const { return !is_mirror_ && !is_straight_ && !is_black(transmitted_); }

  /// The diffuse part's reflectance rho, for light from everywhere evenly.
  Spectrum diffuse_reflectance() const { return diffuse_ * through_o_; }
  /// Its shape: f = diffuse_reflectance() / pi * diffuse_shape(i); 1 for bare Lambertian surfaces.
  float diffuse_shape(const Vec3& to_light) const;
  /// 1/sr; both parts 0 where the light comes from below.
  Spectrum eval_diffuse(const Vec3& to_light) const;

  /// The specular part without its delta lobes, 1/sr, above and below.
  Spectrum eval_specular(const Vec3& to_light) const;
  /// Density per steradian with which sample_specular() chooses a direction, delta lobes left out.
  float pdf_specular(const Vec3& to_light) const;

  struct Sample {
    Vec3 direction{0, 0, 1};
    Spectrum weight;           // f cos / pdf; black: nothing is scattered that way
    float pdf = 0;             // per steradian; 0 of delta lobes
    bool is_delta = false;
  };
  /// `choice` of a lobe and `u` of its direction are uniform random numbers.
  Sample sample_specular(float choice, const Vec2& u) const;

  /// What the specular part scatters of light from the viewer's direction, about; for choosing between the parts.
  Spectrum specular_albedo() const;

 private:
  enum Lobe { kReflection, kMultiple, kTransmission, kMultipleTransmission, kCoat, kSheen, kLobes };
  /// A pair of directions as the lobes see it.
  struct Pair {
    Vec3 i;
    Vec3 h;           // the facet that would scatter between o and i
    float oh = 0;     // dot(o, h)
    float ih = 0;     // dot(i, h); of a thin sheet, of i mirrored
    float sum = 0;    // length of o + eta i, of light that is bent
    float cosine = 0; // |i.z|
    bool is_above = false;
  };

  Vec3 to_local(const Vec3& w) const;
  void add_specular(const Matter& matter);
  void add_transmission(const Matter& matter);
  void choose_probabilities();
  bool is_delta_lobe(int lobe) const;
  bool has_lobe(int lobe) const { return probability_[static_cast<std::size_t>(lobe)] > 0; }
  bool is_bent() const { return layers_.is_glass(); }
  Pair pair_with(const Vec3& i) const;
  Spectrum eval_base(const Pair& p) const;
  Spectrum eval_reflection(const Pair& p) const;
  Spectrum eval_transmission(const Pair& p) const;
  Spectrum eval_layers(const Pair& p) const;
  Spectrum eval(const Pair& p) const;
  float pdf_lobe(int lobe, const Pair& p) const;
  float pdf(const Pair& p) const;
  Sample sample_delta(int lobe) const;
  Vec3 sample_between_facets(const Vec2& u) const;
  Vec3 sample_direction(int lobe, const Vec2& u) const;
  int choose_lobe(float choice) const;

  Frame frame_;
  Vec3 o_;                              // local direction to the viewer
  Spectrum diffuse_;                    // rho of the base under all layers
  float through_o_ = 1;                 // 1 - covered(o)
  float through_mean_ = 1;              // its mean
  bool has_layers_ = false;
  bool has_specular_ = false;
  bool is_delta_ = true;                // all lobes of the specular part are

  Layers layers_;
  Ggx facets_;
  bool is_mirror_ = false;              // facets too fine for a density
  float spread_ = 1, spread_log_ = 1;   // alpha^2 and ln(1 + 1 / alpha^2)
  bool is_straight_ = false;            // so is what they pass: they hardly bend it
  Spectrum transmitted_;                // share and colour of light that enters the base
  float eta_ = 1;                       // index on the far side over that on the viewer's
  bool is_covered_ = false;             // by coat or sheen
  float under_o_ = 1;                   // what coat and sheen let through
  float coat_weight_ = 0;
  float sheen_roughness_ = 0;
  Ggx coat_facets_;
  bool is_coat_mirror_ = false;
  std::array<Spectrum, kLobes> albedo_; // from the viewer's direction, about
  std::array<float, kLobes> probability_{};
};

/// What a pane passes straight on of light at a cosine to its normal, by colour (matter.3). Black of other matter.
Spectrum pane_passage(const Matter& matter, float cosine);

/// What matter reflects of light from one direction: all lobes of the viewer's side together where gloss is folded into
/// diffuse (Matter::folds_specular), else the diffuse one alone; not what it transmits.
Spectrum reflectance(const Matter& matter, float cosine);
/// The same of light from everywhere evenly: reflectance as radiosity uses it.
Spectrum mean_reflectance(const Matter& matter);

}  // namespace radfarm
