#include "matter/albedo.h"

#include <span>

#include "math/sampling.h"
#include "math/sobol.h"
#include "matter/fresnel.h"
#include "matter/ggx.h"
#include "matter/matter.h"
#include "matter/sheen.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kSamples = 1024;  // an entry; stratified
constexpr std::uint64_t kTableKey = 0x616c62;  // "alb"

Vec3 towards(float cosine) { return {std::sqrt(std::max(0.0F, 1 - cosine * cosine)), 0, cosine}; }

GgxAlbedo mirror_albedo(float cosine) { return {1 - schlick_weight(cosine), schlick_weight(cosine)}; }

GgxAlbedo integrate_ggx(std::span<const Vec2> disk, float cosine, float roughness) {
  const Ggx ggx{roughness * roughness, roughness * roughness};
  const Vec3 o = towards(cosine);
  const float lambda_o = ggx.lambda(o);
  double all = 0, at_90 = 0;
  for (const Vec2& point : disk) {
    const Vec3 h = ggx.visible_facet(o, point);
    const Vec3 i = reflect(o, h);
    if (!(i.z > 0)) continue;
    const double weight = static_cast<double>((1 + lambda_o) / (1 + lambda_o + ggx.lambda(i)));
    all += weight;
    at_90 += weight * static_cast<double>(schlick_weight(dot(o, h)));
  }
  const double share = 1 / static_cast<double>(disk.size());
  return {static_cast<float>((all - at_90) * share), static_cast<float>(at_90 * share)};
}

/// `weight`(i.z) is a factor of the lobe. By the midpoints of a grid over azimuth and the cosine's root: smooth sheen has its light
/// at grazing.
template <typename Weight>
float integrate_sheen(float cosine, float roughness, const Weight& weight) {
  constexpr int kRoots = 40, kTurns = 24;
  const Vec3 o = towards(cosine);
  double sum = 0;
  for (int r = 0; r < kRoots; ++r) {
    const float root = (static_cast<float>(r) + 0.5F) / kRoots, z = root * root;
    const float sine = std::sqrt(1 - z * z);
    float ring = 0;
    for (int t = 0; t < kTurns; ++t) {
      const float turn = kPi * (static_cast<float>(t) + 0.5F) / kTurns;
      ring += eval_sheen(roughness, o, {sine * std::cos(turn), sine * std::sin(turn), z});
    }
    sum += static_cast<double>(ring * weight(z) * z * 2 * root);  // dz = 2 root d root
  }
  return static_cast<float>(sum * 2 * static_cast<double>(kPi) / (kRoots * kTurns));
}

/// The factor that brings an albedo to 1, less what the tables may be wrong by.
float at_most_one(float albedo) {
  constexpr float kMost = 0.97F;
  return kMost / std::max(kMost, albedo);
}

/// The bare lobe's albedo.
const AlbedoTable<float>& bare_sheen() {
  static const AlbedoTable<float> table(
      [](float cosine, float roughness) { return integrate_sheen(cosine, roughness, [](float) { return 1.0F; }); });
  return table;
}

AlbedoTable<float> make_sheen_table() {
  constexpr float kNeedsNoScale = 0.4F;  // rougher, the bare lobe stays below kMost everywhere
  return AlbedoTable<float>([](float cosine, float roughness) {
    const AlbedoTable<float>::Curve bare = bare_sheen().curve(roughness);
    if (roughness > kNeedsNoScale) return bare.at(cosine);
    const float scale_o = at_most_one(bare.at(cosine));
    return std::min(1.0F, integrate_sheen(cosine, roughness,
                                          [&](float i_z) { return std::min(scale_o, at_most_one(bare.at(i_z))); }));
  });
}

}  // namespace

std::vector<Vec2> disk_points(std::uint32_t count, std::uint64_t key) {
  std::vector<Vec2> points;
  for (std::uint32_t s = 0; s < count; ++s) points.push_back(sample_uniform_disk(sobol_owen_2d(s, key)));
  return points;
}

GgxAlbedoCurve::GgxAlbedoCurve(float roughness) {
  if (roughness * roughness < kLeastAlpha) return;
  static const AlbedoTable<GgxAlbedo> table([disk = disk_points(kSamples, kTableKey)](float cosine, float rough) {
    return integrate_ggx(disk, cosine, rough);
  });
  curve_ = table.curve(roughness);
}

GgxAlbedo GgxAlbedoCurve::at(float cosine) const {
  return curve_.low != nullptr ? curve_.at(cosine) : mirror_albedo(cosine);
}

SheenCurve::SheenCurve(float roughness) {
  static const AlbedoTable<float> table = make_sheen_table();
  albedo_ = table.curve(roughness);
  bare_ = bare_sheen().curve(roughness);
}

float SheenCurve::scale(float cosine_o, float cosine_i) const {
  return at_most_one(std::max(bare_.at(cosine_o), bare_.at(cosine_i)));
}

}  // namespace radfarm
