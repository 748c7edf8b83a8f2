#include "matter/bsdf.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"
#include "matter/fresnel.h"
#include "matter/sheen.h"

namespace radfarm {
namespace {

Ggx facets_of(const Matter& m) {
  const float alpha = std::max(m.roughness * m.roughness, kLeastAlpha);
  // glTF: the rougher direction goes towards 1 by the square of the strength.
  const float along = alpha + (1 - alpha) * m.anisotropy * m.anisotropy;
  return {along, alpha};
}

/// The direction to the viewer, above the surface: a shading normal may lean away from the viewer.
Vec3 lifted(const Vec3& o) {
  constexpr float kLeastCosine = 1e-6F;
  return o.z >= kLeastCosine ? o : normalize(Vec3(o.x, o.y, kLeastCosine));
}

}  // namespace

Bsdf::Bsdf(const Matter& matter, const Frame& frame, const Vec3& to_viewer, bool is_front) : frame_(frame) {
  diffuse_ = matter.base * ((1 - matter.metallic) * (1 - matter.transmission));
  if (matter.is_lambertian()) return;
  if (matter.anisotropy > 0) {
    // Seen from behind, the frame is mirrored: the angle is one of the surface.
    const float angle = is_front ? matter.anisotropy_rotation : -matter.anisotropy_rotation;
    const float c = std::cos(angle), s = std::sin(angle);
    frame_.tangent = frame.tangent * c + frame.bitangent * s;
    frame_.bitangent = frame.bitangent * c - frame.tangent * s;
  }
  o_ = lifted(to_local(to_viewer));
  has_layers_ = true;
  eta_ = is_front ? matter.ior : 1 / matter.ior;
  layers_ = Layers(matter, is_front);
  is_covered_ = layers_.has_coat() || layers_.has_sheen();
  under_o_ = is_covered_ ? layers_.let_through(o_.z) : 1;
  add_specular(matter);
  add_transmission(matter);
  if (has_diffuse()) {
    through_o_ = layers_.entering(o_.z);
    through_mean_ = std::max(1e-6F, 1 - layers_.covered_mean());
  }
  choose_probabilities();
}

void Bsdf::add_specular(const Matter& m) {
  facets_ = facets_of(m);
  is_mirror_ = layers_.is_mirror();
  if (!is_mirror_) {
    spread_ = facets_.alpha_x * facets_.alpha_y;
    spread_log_ = std::log1p(1 / spread_);
  }
  albedo_[kReflection] = layers_.single_albedo(o_.z) * under_o_;
  albedo_[kMultiple] = layers_.multiple_albedo(o_.z) * under_o_;
  if (layers_.has_coat()) {
    const float alpha = std::max(m.clearcoat_roughness * m.clearcoat_roughness, kLeastAlpha);
    coat_facets_ = {alpha, alpha};
    is_coat_mirror_ = is_smooth(m.clearcoat_roughness);
    coat_weight_ = m.clearcoat;
    albedo_[kCoat] = Spectrum(layers_.coat_albedo(o_.z));
  }
  if (layers_.has_sheen()) {
    sheen_roughness_ = m.sheen_roughness;
    albedo_[kSheen] = layers_.sheen_albedo(o_.z);
  }
}

void Bsdf::add_transmission(const Matter& m) {
  if (m.is_pane() || m.transmission * (1 - m.metallic) == 0) return;
  transmitted_ = m.base * (m.transmission * (1 - m.metallic));
  is_straight_ = layers_.is_straight() && !is_mirror_;
  if (is_straight_) {
    albedo_[kTransmission] = transmitted_ * layers_.entering(o_.z);
    return;
  }
  albedo_[kTransmission] = transmitted_ * (layers_.passed_albedo(o_.z) * under_o_);
  albedo_[kMultipleTransmission] = transmitted_ * (layers_.multiple_albedo_across(o_.z) * under_o_);
}

void Bsdf::choose_probabilities() {
  float total = 0;
  for (const Spectrum& albedo : albedo_) total += luminance(albedo);
  if (!(total > 0)) return;
  has_specular_ = true;
  for (int lobe = 0; lobe < kLobes; ++lobe) {
    const auto k = static_cast<std::size_t>(lobe);
    probability_[k] = luminance(albedo_[k]) / total;
    is_delta_ = is_delta_ && (probability_[k] == 0 || is_delta_lobe(lobe));
  }
}

bool Bsdf::is_delta_lobe(int lobe) const {
  if (lobe == kReflection) return is_mirror_;
  if (lobe == kTransmission) return is_mirror_ || is_straight_;
  return lobe == kCoat && is_coat_mirror_;
}

Vec3 Bsdf::to_local(const Vec3& w) const { return {dot(w, frame_.tangent), dot(w, frame_.bitangent), dot(w, frame_.normal)}; }

float Bsdf::diffuse_shape(const Vec3& to_light) const {
  if (!has_layers_) return 1;
  // (matter.4) Reciprocal, and exactly what the layers leave: (1 - k(o)) (1 - k(i)) / (1 - mean k). [Kelemen 2001]
  return layers_.entering(std::max(0.0F, dot(to_light, frame_.normal))) / through_mean_;
}

Spectrum Bsdf::eval_diffuse(const Vec3& to_light) const {
  if (!(dot(to_light, frame_.normal) > 0)) return {};
  return diffuse_reflectance() * (kInversePi * diffuse_shape(to_light));
}

/// The facet that would scatter between o and i is along their sum, weighted by the indices for light that is bent. The sum's
/// length has the cosines at the facet, which dot products would lose to rounding at grazing.
Bsdf::Pair Bsdf::pair_with(const Vec3& i) const {
  const bool is_above = i.z > 0;
  if (is_above || !is_bent()) {
    const Vec3 sum = o_ + Vec3(i.x, i.y, std::fabs(i.z));
    const float size = length(sum);
    return {i, sum / std::max(size, 1e-30F), size / 2, size / 2, 0, std::fabs(i.z), is_above};
  }
  const Vec3 sum = o_ + i * eta_;
  const float size = std::max(length(sum), 1e-30F);
  const Vec3 h = sum * ((sum.z < 0 ? -1 : 1) / size);
  return {i, h, dot(o_, h), dot(i, h), size, std::fabs(i.z), is_above};
}

Spectrum Bsdf::eval_reflection(const Pair& p) const {
  Spectrum f;
  if (has_lobe(kReflection) && !is_mirror_) {
    f += layers_.fresnel(p.oh) * (facets_.distribution(p.h) * facets_.visibility(o_, p.i));
  }
  if (has_lobe(kMultiple)) f += layers_.between_facets(o_.z, p.cosine);
  return f;
}

Spectrum Bsdf::eval_transmission(const Pair& p) const {
  if (!has_lobe(kTransmission) || is_delta_lobe(kTransmission)) return {};
  float f = has_lobe(kMultipleTransmission) ? layers_.between_facets_across(o_.z, p.cosine) : 0;
  if (p.oh > 0 && (!is_bent() || p.ih < 0)) {
    const float seen = facets_.distribution(p.h) * facets_.visibility(o_, {p.i.x, p.i.y, p.cosine});
    // (matter.5) Of basic radiance; a thin sheet's is that of reflection, mirrored.
    const float spread = is_bent() ? 4 * std::fabs(p.oh * p.ih) * eta_ * eta_ / (p.sum * p.sum) : 1;
    f += layers_.facet_passes(p.oh) * seen * spread;
  }
  return transmitted_ * f;
}

/// What lies under coat and sheen. The lesser of what they let through for either direction keeps it reciprocal; it loses a
/// little where they differ much (docs/materials.md has the measure).
Spectrum Bsdf::eval_base(const Pair& p) const {
  const Spectrum f = p.is_above ? eval_reflection(p) : eval_transmission(p);
  return is_covered_ ? f * std::min(under_o_, layers_.let_through(p.cosine)) : f;
}

/// Coat and sheen.
Spectrum Bsdf::eval_layers(const Pair& p) const {
  Spectrum f;
  if (has_lobe(kCoat) && !is_coat_mirror_) {
    const float fresnel = kCoatF0 + (1 - kCoatF0) * schlick_weight(p.oh);
    f += Spectrum(coat_weight_ * fresnel * coat_facets_.distribution(p.h) * coat_facets_.visibility(o_, p.i));
  }
  if (has_lobe(kSheen)) {
    f += layers_.sheen_weight(o_.z, p.cosine) * eval_sheen(sheen_roughness_, o_, p.i);
  }
  return f;
}

Spectrum Bsdf::eval(const Pair& p) const {
  const Spectrum base = eval_base(p);
  return is_covered_ && p.is_above ? base + eval_layers(p) : base;
}

float Bsdf::pdf_lobe(int lobe, const Pair& p) const {
  if ((lobe == kTransmission || lobe == kMultipleTransmission) == p.is_above || is_delta_lobe(lobe)) return 0;
  if (lobe == kReflection) return facets_.pdf_reflected(o_, p.h);
  if (lobe == kCoat) return coat_facets_.pdf_reflected(o_, p.h);
  if (lobe == kSheen) return 0.5F * kInversePi;
  if (lobe != kTransmission) return p.cosine * kInversePi / ((p.cosine * p.cosine + spread_) * spread_log_);
  if (!is_bent()) return facets_.pdf_reflected(o_, p.h);
  if (!(p.oh > 0 && p.ih < 0)) return 0;
  return facets_.pdf_visible(o_, p.h) * eta_ * eta_ * std::fabs(p.ih) / (p.sum * p.sum);
}

float Bsdf::pdf(const Pair& p) const {
  float sum = 0;
  for (int lobe = 0; lobe < kLobes; ++lobe) {
    const float probability = probability_[static_cast<std::size_t>(lobe)];
    if (probability > 0) sum += probability * pdf_lobe(lobe, p);
  }
  return sum;
}

Spectrum Bsdf::eval_specular(const Vec3& to_light) const {
  if (!has_specular_ || is_delta_) return {};
  const Vec3 i = to_local(to_light);
  return i.z == 0 ? Spectrum() : eval(pair_with(i));
}

float Bsdf::pdf_specular(const Vec3& to_light) const {
  if (!has_specular_ || is_delta_) return 0;
  const Vec3 i = to_local(to_light);
  return i.z == 0 ? 0 : pdf(pair_with(i));
}

/// What goes on between facets leaves at cosines not much above alpha: density ~ z / (z^2 + alpha^2), inverted.
Vec3 Bsdf::sample_between_facets(const Vec2& u) const {
  const float z_squared = std::min(1.0F, spread_ * std::expm1(u.x * spread_log_));
  const float sine = std::sqrt(1 - z_squared), turn = 2 * kPi * u.y;
  return {sine * std::cos(turn), sine * std::sin(turn), std::sqrt(z_squared)};
}

Vec3 Bsdf::sample_direction(int lobe, const Vec2& u) const {
  if (lobe == kReflection) return reflect(o_, facets_.sample_visible(o_, u));
  if (lobe == kCoat) return reflect(o_, coat_facets_.sample_visible(o_, u));
  if (lobe == kTransmission) {
    const Vec3 h = facets_.sample_visible(o_, u);
    if (is_bent()) return refract(o_, h, eta_);
    const Vec3 mirrored = reflect(o_, h);
    return {mirrored.x, mirrored.y, -mirrored.z};
  }
  if (lobe == kSheen) return sample_uniform_hemisphere(u);
  const Vec3 i = sample_between_facets(u);
  return lobe == kMultipleTransmission ? Vec3(i.x, i.y, -i.z) : i;
}

/// Lobes of mirrors and clear glass: one direction, chosen with the lobe's probability.
Bsdf::Sample Bsdf::sample_delta(int lobe) const {
  const auto k = static_cast<std::size_t>(lobe);
  Vec3 i(-o_.x, -o_.y, o_.z);
  if (lobe == kTransmission) {
    i = refract(o_, {0, 0, 1}, eta_);
    if (!(i.z < 0)) i = -o_;  // rough, and hardly bent: its facets have no one critical angle
  }
  return {normalize(frame_.to_world(i)), albedo_[k] / probability_[k], 0, true};
}

int Bsdf::choose_lobe(float choice) const {
  int last = 0;
  float until = 0;
  for (int lobe = 0; lobe < kLobes; ++lobe) {
    if (!has_lobe(lobe)) continue;
    last = lobe;
    until += probability_[static_cast<std::size_t>(lobe)];
    if (choice < until) break;
  }
  return last;
}

Bsdf::Sample Bsdf::sample_specular(float choice, const Vec2& u) const {
  if (!has_specular_) return {};
  const int lobe = choose_lobe(choice);
  if (is_delta_lobe(lobe)) return sample_delta(lobe);
  const Vec3 i = sample_direction(lobe, u);
  const bool is_below = lobe == kTransmission || lobe == kMultipleTransmission;
  if (is_below ? !(i.z < 0) : !(i.z > 0)) return {};
  Sample sample;
  sample.direction = normalize(frame_.to_world(i));
  const Pair pair = pair_with(to_local(sample.direction));
  sample.pdf = pdf(pair);
  if (!(sample.pdf > 0) || !std::isfinite(sample.pdf)) return {};
  sample.weight = eval(pair) * (pair.cosine / sample.pdf);
  return sample;
}

Spectrum Bsdf::specular_albedo() const {
  Spectrum sum;
  for (const Spectrum& albedo : albedo_) sum += albedo;
  return sum;
}

Spectrum pane_passage(const Matter& m, float cosine) {
  if (!m.is_pane()) return {};
  // Every ray through a window asks this: without coat and sheen no layers are made.
  const float entering = m.clearcoat == 0 && is_black(m.sheen) ? pane_entering(m, cosine) : Layers(m, true).entering(cosine);
  return m.base * (m.transmission * (1 - m.metallic) * entering);
}

namespace {

/// The layers hold all but what the matter's base does.
Spectrum reflectance_under(const Layers& layers, const Matter& m, float cosine) {
  const Spectrum diffuse = m.base * ((1 - m.metallic) * (1 - m.transmission));
  const Spectrum specular = m.folds_specular ? layers.reflected(cosine) : Spectrum();
  const Spectrum all = specular + diffuse * layers.entering(cosine);
  return {std::min(all.r, 1.0F), std::min(all.g, 1.0F), std::min(all.b, 1.0F)};
}

}  // namespace

Spectrum reflectance(const Matter& m, float cosine) {
  return m.is_lambertian() ? m.base : reflectance_under(Layers(m, true), m, cosine);
}

Spectrum mean_reflectance(const Matter& m) {
  if (m.is_lambertian()) return m.base;
  const Layers layers(m, true);
  return hemisphere_mean([&](float cosine) { return reflectance_under(layers, m, cosine); });
}

}  // namespace radfarm
