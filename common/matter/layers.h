#pragma once

#include <array>

#include "math/spectrum.h"
#include "matter/albedo.h"
#include "matter/glass.h"
#include "matter/matter.h"

namespace radfarm {

/// The layers of matter as functions of the cosine to the normal: what each reflects, and what it leaves to those below. From the
/// top: a clear coat, sheen, and the interface of the base, which is a dielectric layer and metal by shares.   (matter.1), (matter.2)
class Layers {
 public:
  Layers() = default;
  /// `is_front`: seen from outside a volume.
  Layers(const Matter& matter, bool is_front);

  bool has_coat() const { return coat_ > 0; }
  bool has_sheen() const { return !is_black(sheen_); }
  /// The interface is too fine for a density.
  bool is_mirror() const { return is_mirror_; }
  /// It bends light that passes it: both sides of it scatter into each other.
  bool is_glass() const { return interface_ == Interface::kGlass; }
  /// Its facets bend what passes them by less than a density can hold: rough, but light goes straight on.
  bool is_straight() const { return is_straight_; }

  /// The coat, and the sheen below it.
  float coat_albedo(float cosine) const;
  Spectrum sheen_albedo(float cosine) const;
  /// What eval_sheen() is multiplied by: the sheen's colour, scaled, and what the coat leaves of it.
  Spectrum sheen_weight(float cosine_o, float cosine_i) const;
  /// Share of light that coat and sheen let through to the layers below.
  float let_through(float cosine) const;

  /// What one facet of the interface reflects, metal and dielectric together, and the share that passes its dielectric.
  Spectrum fresnel(float cosine) const;
  float facet_passes(float cosine) const;
  /// The facets' albedo, and the colours of what goes on between them: on the viewer's side, and across a thin sheet or glass.
  Spectrum single_albedo(float cosine) const;
  Spectrum between_facets(float cosine_o, float cosine_i) const;
  float between_facets_across(float cosine_o, float cosine_i) const;
  /// Albedos of the last two, of light from `cosine`, and of light that passes one facet.
  Spectrum multiple_albedo(float cosine) const;
  float multiple_albedo_across(float cosine) const;
  float passed_albedo(float cosine) const;

  /// Share of light from `cosine` that does not reach the base, and its cosine-weighted mean.
  float covered(float cosine) const { return 1 - (1 - kept_out(cosine)) * let_through(cosine); }
  float covered_mean() const;

  /// All that is reflected, but for what the base does with light that enters it.
  Spectrum reflected(float cosine) const;
  /// Share of light that enters the base.
  float entering(float cosine) const { return std::max(0.0F, 1 - covered(cosine)); }

 private:
  enum class Interface { kSchlick, kPane, kGlass };

  void add_multiple(const Matter& matter);
  float exact(float cosine) const;
  bool is_exact() const { return is_mirror_ && interface_ != Interface::kSchlick; }
  float kept_out(float cosine) const;
  Spectrum dielectric_multiple() const;

  Interface interface_ = Interface::kSchlick;
  bool is_mirror_ = false;
  bool is_straight_ = false;
  float goes_on_ = 0;                   // share of light between facets that is followed; 1 but of anisotropic ones
  float roughness_ = 0;                 // of the albedo tables
  float ior_ = 1.5F;
  float eta_ = 1.5F;                    // the far side's index over the near one's
  float metallic_ = 0;
  float specular_ = 0;
  Spectrum layer_color_;                // of the dielectric where its Fresnel reflectance is exact
  Spectrum dielectric_f0_, metal_f0_;
  float max_layer_ = 0;                 // largest channels of layer_color_ and dielectric_f0_
  float max_f0_ = 0;
  Spectrum f0_, f90_;                   // of metal and Schlick's dielectric by their shares
  Spectrum multiple_;                   // of them, Kulla and Conty's colour; of glass, only the metal's share
  float max_multiple_ = 0;              // the dielectric's, its largest channel
  GgxAlbedoCurve facets_;
  GgxAlbedoCurve cover_;                // of the dielectric, as what lies below sees it
  RoughGlass glass_;
  float coat_ = 0;
  GgxAlbedoCurve coat_facets_;
  Spectrum sheen_;
  float max_sheen_ = 0;
  SheenCurve sheen_curve_;
};

/// Facets of the coat, which is a dielectric of index 1.5.
inline constexpr float kCoatF0 = 0.04F;

/// Share of light that enters the base of a pane without coat and sheen.
float pane_entering(const Matter& matter, float cosine);

inline bool is_smooth(float roughness) { return roughness * roughness < kLeastAlpha; }

/// Mean over the hemisphere, cosine-weighted: 2 int g(mu) mu dmu = 4 int g t^3 dt over the cosine's root t, by Gauss's formula.
template <typename G>
auto hemisphere_mean(const G& g) {
  constexpr std::array<float, 8> kAt = {0.0198550718F, 0.1016667613F, 0.2372337950F, 0.4082826788F,
                                        0.5917173212F, 0.7627662050F, 0.8983332387F, 0.9801449282F};
  constexpr std::array<float, 8> kWeight = {0.0506142681F, 0.1111905172F, 0.1568533229F, 0.1813418917F,
                                            0.1813418917F, 0.1568533229F, 0.1111905172F, 0.0506142681F};
  decltype(g(0.0F)) sum{};
  for (std::size_t k = 0; k < kAt.size(); ++k) {
    sum += g(kAt[k] * kAt[k]) * (4 * kAt[k] * kAt[k] * kAt[k] * kWeight[k]);
  }
  return sum;
}

}  // namespace radfarm
