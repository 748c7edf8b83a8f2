#include "matter/layers.h"

#include <algorithm>
#include <cmath>

#include "math/vec.h"
#include "matter/fresnel.h"

namespace radfarm {
namespace {

Spectrum mix(const Spectrum& a, const Spectrum& b, float share) { return a * (1 - share) + b * share; }
Spectrum at_most_one(const Spectrum& s) { return {std::min(s.r, 1.0F), std::min(s.g, 1.0F), std::min(s.b, 1.0F)}; }

/// (matter.2) The colour of light that goes on between facets of mean Fresnel reflectance F: F^2 E / (1 - F (1 - E)).
float multiple_color(float f0, float f90, float mean_albedo) {
  const float mean = f0 + (f90 - f0) / 21;  // cosine-weighted mean of Schlick's formula
  return mean * mean * mean_albedo / (1 - mean * (1 - mean_albedo));
}

Spectrum multiple_color(const Spectrum& f0, float f90, float mean_albedo) {
  return {multiple_color(f0.r, f90, mean_albedo), multiple_color(f0.g, f90, mean_albedo),
          multiple_color(f0.b, f90, mean_albedo)};
}

/// For the albedo tables: the geometric mean of both directions.
float effective_roughness(const Matter& m) {
  if (m.anisotropy == 0 || m.is_pane()) return m.roughness;
  const float across = std::max(m.roughness * m.roughness, kLeastAlpha);
  return std::pow(across * (across + (1 - across) * m.anisotropy * m.anisotropy), 0.25F);
}

/// Of light that meets a second facet, what the tables follow. They know no azimuth: the more anisotropic, the less is given back
/// of it, so that it never is too much.
float share_that_goes_on(const Matter& m) {
  if (m.anisotropy == 0) return 1;
  const float across = std::max(m.roughness * m.roughness, kLeastAlpha);
  const float ratio = across / (across + (1 - across) * m.anisotropy * m.anisotropy);
  return ratio * ratio * ratio;
}

}  // namespace

float pane_entering(const Matter& m, float cosine) {
  return 1 - max_component(at_most_one(m.specular_color)) * m.specular * (1 - pane_transmittance(cosine, m.ior));
}

Layers::Layers(const Matter& m, bool is_front)
    : roughness_(effective_roughness(m)), ior_(m.ior), metallic_(m.metallic), specular_(m.specular), coat_(m.clearcoat) {
  const bool transmits = m.transmission * (1 - m.metallic) > 0;
  if (m.is_pane()) interface_ = Interface::kPane;
  if (m.has_volume && transmits) interface_ = Interface::kGlass;
  eta_ = is_front ? m.ior : 1 / m.ior;
  // Facets that bend by less than a density can hold pass light straight on; fine ones are smooth glass altogether.
  constexpr float kLeastBend = 1e-4F, kLeastLogIndex = 2e-3F, kFine = 1e-2F;
  const float alpha = roughness_ * roughness_, bend = std::fabs(std::log(m.ior));
  is_straight_ = is_glass() && (alpha * bend < kLeastBend || bend < kLeastLogIndex);
  is_mirror_ = (is_smooth(roughness_) && (m.anisotropy == 0 || m.is_pane())) || (is_straight_ && alpha < kFine);
  layer_color_ = at_most_one(m.specular_color) * m.specular;
  dielectric_f0_ = at_most_one(m.specular_color * normal_reflectance(m.ior)) * m.specular;
  max_layer_ = max_component(layer_color_);
  max_f0_ = max_component(dielectric_f0_);
  metal_f0_ = m.base;
  f0_ = mix(dielectric_f0_, metal_f0_, m.metallic);
  f90_ = Spectrum(m.specular * (1 - m.metallic) + m.metallic);
  facets_ = GgxAlbedoCurve(roughness_);
  goes_on_ = is_mirror_ ? 0 : share_that_goes_on(m);
  if (!is_mirror_) add_multiple(m);
  // Seen across the tangent, anisotropic facets reflect more than the tables say; a mirror never reflects less.
  if (m.anisotropy == 0) cover_ = facets_;
  if (coat_ > 0) coat_facets_ = GgxAlbedoCurve(m.clearcoat_roughness);
  if (is_black(m.sheen)) return;
  sheen_ = m.sheen;
  max_sheen_ = max_component(sheen_);
  sheen_curve_ = SheenCurve(m.sheen_roughness);
}

void Layers::add_multiple(const Matter& m) {
  const float mean = facets_.mean().total();
  multiple_ = multiple_color(metal_f0_, 1, mean) * (m.metallic * goes_on_);
  if (interface_ == Interface::kGlass) {
    glass_ = rough_glass(m.ior, roughness_, eta_ == m.ior);
    if (is_straight_) glass_.stays = 0;  // all that is not reflected goes on
    return;
  }
  multiple_ += multiple_color(dielectric_f0_, m.specular, mean) * ((1 - m.metallic) * goes_on_);
  max_multiple_ = multiple_color(max_f0_, m.specular, mean) * goes_on_;
}

float Layers::coat_albedo(float cosine) const {
  if (coat_ == 0) return 0;
  const GgxAlbedo e = coat_facets_.at(cosine);
  return coat_ * (kCoatF0 * e.at_0 + e.at_90);
}

Spectrum Layers::sheen_albedo(float cosine) const {
  if (!has_sheen()) return {};
  return sheen_ * (sheen_curve_.at(cosine) * (1 - coat_albedo(cosine)));
}

Spectrum Layers::sheen_weight(float cosine_o, float cosine_i) const {
  const float coated = std::max(coat_albedo(cosine_o), coat_albedo(cosine_i));
  return sheen_ * (sheen_curve_.scale(cosine_o, cosine_i) * (1 - coated));
}

float Layers::let_through(float cosine) const {
  const float below_coat = 1 - coat_albedo(cosine);
  return has_sheen() ? below_coat * (1 - max_sheen_ * sheen_curve_.at(cosine)) : below_coat;
}

/// Of a pane, all reflections between its faces added up; otherwise of one interface.
float Layers::exact(float cosine) const {
  return interface_ == Interface::kPane ? 1 - pane_transmittance(cosine, ior_) : fresnel_dielectric(cosine, eta_);
}

Spectrum Layers::fresnel(float cosine) const {
  const float weight = schlick_weight(cosine);
  if (interface_ == Interface::kSchlick) return f0_ + (f90_ - f0_) * weight;
  return mix(layer_color_ * exact(cosine), metal_f0_ + (Spectrum(1.0F) - metal_f0_) * weight, metallic_);
}

float Layers::facet_passes(float cosine) const {
  if (interface_ == Interface::kSchlick) return 1 - max_f0_ - (specular_ - max_f0_) * schlick_weight(cosine);
  return 1 - max_layer_ * exact(cosine);
}

Spectrum Layers::single_albedo(float cosine) const {
  if (is_exact()) return fresnel(cosine);
  const GgxAlbedo e = facets_.at(cosine);
  if (interface_ == Interface::kSchlick) return f0_ * e.at_0 + f90_ * e.at_90;
  return mix(layer_color_ * glass_.near.at(cosine).reflected, metal_f0_ * e.at_0 + Spectrum(e.at_90), metallic_);
}

/// 1/sr.
Spectrum Layers::between_facets(float cosine_o, float cosine_i) const {
  if (goes_on_ == 0) return {};
  const auto evenly = [](float lost_o, float lost_i, float mean) { return lost_o * lost_i / (kPi * std::max(1e-9F, mean)); };
  Spectrum f = multiple_ * evenly(facets_.at(cosine_o).lost(), facets_.at(cosine_i).lost(), facets_.mean().lost());
  if (is_glass()) {
    f += dielectric_multiple() *
         evenly(glass_.near.at(cosine_o).lost(), glass_.near.at(cosine_i).lost(), glass_.near.mean.lost());
  }
  return f;
}

/// 1/sr, into the base; times the share and colour of what the base passes.
float Layers::between_facets_across(float cosine_o, float cosine_i) const {
  if (goes_on_ == 0) return 0;
  if (is_glass()) {
    return max_layer_ * goes_on_ * (1 - glass_.stays) * glass_.near.at(cosine_o).lost() * glass_.far.at(cosine_i).lost() /
           (kPi * std::max(1e-9F, glass_.far.mean.lost()));
  }
  return (goes_on_ - max_multiple_) * facets_.at(cosine_o).lost() * facets_.at(cosine_i).lost() /
         (kPi * std::max(1e-9F, facets_.mean().lost()));
}

Spectrum Layers::dielectric_multiple() const { return layer_color_ * ((1 - metallic_) * goes_on_ * glass_.stays); }

Spectrum Layers::multiple_albedo(float cosine) const {
  if (goes_on_ == 0) return {};
  const Spectrum facets = multiple_ * facets_.at(cosine).lost();
  return is_glass() ? facets + dielectric_multiple() * glass_.near.at(cosine).lost() : facets;
}

float Layers::multiple_albedo_across(float cosine) const {
  if (goes_on_ == 0) return 0;
  if (is_glass()) return max_layer_ * goes_on_ * (1 - glass_.stays) * glass_.near.at(cosine).lost();
  return (goes_on_ - max_multiple_) * facets_.at(cosine).lost();
}

float Layers::passed_albedo(float cosine) const {
  if (is_exact()) return facet_passes(cosine);
  if (is_glass()) {
    const GlassAlbedo e = glass_.near.at(cosine);
    // A coloured or weakened layer passes more, about. Never 0: facets pass light where a smooth face would not.
    return std::max(1e-3F, e.transmitted + (1 - max_layer_) * e.reflected);
  }
  const GgxAlbedo e = facets_.at(cosine);
  return std::max(0.0F, e.total() - max_f0_ * e.at_0 - specular_ * e.at_90);
}

/// Share of light that the dielectric of the interface keeps out of the base.
float Layers::kept_out(float cosine) const {
  if (specular_ == 0) return 0;
  if (is_exact()) return max_layer_ * exact(cosine);
  if (is_glass()) {
    const GlassAlbedo e = glass_.near.at(cosine);
    const float reflected = e.reflected + goes_on_ * glass_.stays * e.lost();
    return max_layer_ * (goes_on_ == 1 ? reflected : std::max(reflected, exact(cosine)));
  }
  const GgxAlbedo e = cover_.at(cosine);
  return max_f0_ * e.at_0 + specular_ * e.at_90 + max_multiple_ * e.lost();
}

float Layers::covered_mean() const {
  if (coat_ > 0 || has_sheen() || is_exact() || (is_glass() && goes_on_ < 1)) {
    return hemisphere_mean([this](float cosine) { return covered(cosine); });
  }
  if (is_glass()) return max_layer_ * (glass_.near.mean.reflected + goes_on_ * glass_.stays * glass_.near.mean.lost());
  const GgxAlbedo e = cover_.mean();
  return max_f0_ * e.at_0 + specular_ * e.at_90 + max_multiple_ * e.lost();
}

Spectrum Layers::reflected(float cosine) const {
  const Spectrum interface = single_albedo(cosine) + multiple_albedo(cosine);
  return Spectrum(coat_albedo(cosine)) + sheen_albedo(cosine) + interface * let_through(cosine);
}

}  // namespace radfarm
