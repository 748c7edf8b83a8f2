#include "matter/glass.h"

#include <atomic>
#include <memory>
#include <mutex>

#include "matter/albedo.h"
#include "matter/fresnel.h"
#include "matter/ggx.h"
#include "matter/matter.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kSamples = 1024;          // an entry; stratified
constexpr std::uint64_t kTableKey = 0x676c73;     // "gls"
constexpr float kIndicesPerUnit = 128;            // of the index's logarithm

GlassAlbedo integrate_glass(const std::vector<Vec2>& disk, float cosine, float roughness, float eta) {
  const Ggx ggx{roughness * roughness, roughness * roughness};
  const Vec3 o(std::sqrt(std::max(0.0F, 1 - cosine * cosine)), 0, cosine);
  const float lambda_o = ggx.lambda(o);
  const auto seen = [&](const Vec3& i) { return static_cast<double>((1 + lambda_o) / (1 + lambda_o + ggx.lambda(i))); };
  double reflected = 0, transmitted = 0;
  for (const Vec2& point : disk) {
    const Vec3 h = ggx.visible_facet(o, point);
    const double fresnel = static_cast<double>(fresnel_dielectric(dot(o, h), eta));
    const Vec3 above = reflect(o, h), below = refract(o, h, eta);
    if (above.z > 0) reflected += fresnel * seen(above);
    if (below.z < 0) transmitted += (1 - fresnel) * seen(below);
  }
  const double share = 1 / static_cast<double>(disk.size());
  return {static_cast<float>(reflected * share), static_cast<float>(transmitted * share)};
}

/// Both sides of the interface of one index.
struct GlassTables {
  GlassTables(int which, float ior, const std::vector<Vec2>& disk)
      : key(which),
        outside([&](float cosine, float roughness) { return integrate_glass(disk, cosine, roughness, ior); }),
        inside([&](float cosine, float roughness) { return integrate_glass(disk, cosine, roughness, 1 / ior); }) {}

  int key;
  AlbedoTable<GlassAlbedo> outside;
  AlbedoTable<GlassAlbedo> inside;
  std::unique_ptr<GlassTables> next;
};

/// The list grows at its head and is never cut: readers need no lock.
const GlassTables& tables_of(float ior) {
  static std::atomic<const GlassTables*> head = nullptr;
  static std::unique_ptr<GlassTables> owner;
  static std::mutex growing;
  const int key = static_cast<int>(std::lround(std::log(ior) * kIndicesPerUnit));
  const auto find = [&]() -> const GlassTables* {
    for (const GlassTables* t = head.load(std::memory_order_acquire); t != nullptr; t = t->next.get()) {
      if (t->key == key) return t;
    }
    return nullptr;
  };
  if (const GlassTables* found = find()) return *found;
  const std::lock_guard lock(growing);
  if (const GlassTables* found = find()) return *found;
  auto made = std::make_unique<GlassTables>(key, std::exp(static_cast<float>(key) / kIndicesPerUnit),
                                            disk_points(kSamples, kTableKey));
  made->next = std::move(owner);
  owner = std::move(made);
  head.store(owner.get(), std::memory_order_release);
  return *owner;
}

}  // namespace

RoughGlass rough_glass(float ior, float roughness, bool is_front) {
  const GlassTables& tables = tables_of(ior);
  const AlbedoTable<GlassAlbedo>&near = is_front ? tables.outside : tables.inside, &far = is_front ? tables.inside : tables.outside;
  RoughGlass glass{near.curve(roughness), far.curve(roughness), 0.5F};
  // Light that has met many facets no longer knows its side: it leaves by either in proportion to its flux.
  const float eta = is_front ? ior : 1 / ior;
  const float near_flux = glass.near.mean.lost(), far_flux = glass.far.mean.lost() * eta * eta;
  if (near_flux + far_flux > 0) glass.stays = near_flux / (near_flux + far_flux);
  return glass;
}

}  // namespace radfarm
