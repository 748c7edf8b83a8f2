#include "effects/specular_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "paths/photon_path.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kPaths = 1 << 14;
constexpr std::size_t kGrain = 512;
constexpr std::uint64_t kShareKey = 0x73686172;  // "shar"
// GGX alpha of .16: a lobe some 20 degrees wide. docs/decisions/0024
constexpr float kSharpRoughness = 0.4F;
enum Sender : std::size_t { kNotSpecular, kSharp, kRough, kSenders };

/// The mean of what scales a roughness: green, linear; 1 without a texture. O(texels).
float mean_green(const Scene& scene, const TextureUse& use) {
  if (!use.is_used()) return 1;
  const Texture& texture = scene.textures[use.texture];
  std::uint64_t sum = 0;
  for (const auto& texel : texture.texels) sum += texel[1];
  return static_cast<float>(static_cast<double>(sum) / (255.0 * static_cast<double>(texture.texels.size())));
}

/// A texture only lowers the factor: most need no look at their texels.
bool is_below(const Scene& scene, float factor, const TextureUse& texture) {
  return factor < kSharpRoughness || factor * mean_green(scene, texture) < kSharpRoughness;
}

/// What paths brought, by sender: sums of one path's light and of its square, luminance.
struct Brought {
  std::array<double, kSenders> light{}, squared{};
  double arrivals = 0;

  void add_path(const std::array<double, kSenders>& path) {
    for (std::size_t i = 0; i < kSenders; ++i) light[i] += path[i], squared[i] += path[i] * path[i];
  }
  Brought& operator+=(const Brought& o) {
    for (std::size_t i = 0; i < kSenders; ++i) light[i] += o.light[i], squared[i] += o.squared[i];
    arrivals += o.arrivals;
    return *this;
  }
};

/// What of the light a material reflects as diffuse, textures left out.
float diffuse_share(const Material& m) { return luminance(m.base_color) * (1 - m.metallic) * (1 - m.transmission); }

void follow(const World& world, const std::vector<bool>& sharp, std::uint64_t seed, std::uint32_t index, Brought& brought) {
  std::array<double, kSenders> path{};
  std::uint32_t left = kNone, last = kNone;  // materials that the segment left, and that was met last
  const auto see = [&](const Segment& segment) {
    if (segment.begin == 0) left = last;  // else it goes on through a pane
    if (segment.instance == kNone) return;
    const std::uint32_t met = world.scene.meshes[world.scene.instances[segment.instance].mesh].material;
    const std::size_t sender = !segment.leaves_specular ? kNotSpecular : (sharp[left] ? kSharp : kRough);
    const float reflected = luminance(segment.power) * diffuse_share(world.scene.materials[met]);
    path[sender] += static_cast<double>(reflected);
    if (reflected > 0) brought.arrivals += 1;
    last = met;
  };
  (void)follow_path(world, combine(seed, kShareKey), index, see);
  brought.add_path(path);
}

SpecularShare share_of(const Brought& brought, Sender sender) {
  double all = 0;
  for (const double light : brought.light) all += light;
  if (!(all > 0)) return {0, 1};
  constexpr double kZ = 1.645;  // one-sided 95 %
  const double light = brought.light[sender];
  const double spread = std::sqrt(std::max(0.0, brought.squared[sender] - light * light / kPaths));
  // The rule of three where no path showed any.
  const double at_most = light > 0 ? (light + kZ * spread) / all : 3 / std::max(3.0, brought.arrivals);
  return {light / all, std::min(1.0, at_most)};
}

}  // namespace

bool is_sharp(const Scene& scene, const Material& m) {
  if (m.clearcoat > 0 && is_below(scene, m.clearcoat_roughness, m.clearcoat_roughness_texture)) return true;
  const bool has_lobe = m.metallic > 0 || m.specular > 0 || m.transmission > 0;
  return has_lobe && is_below(scene, m.roughness, m.metallic_roughness_texture);
}

SpecularShares measure_specular_shares(const World& world, std::uint64_t seed) {
  std::vector<bool> sharp;
  for (const Material& material : world.scene.materials) sharp.push_back(is_sharp(world.scene, material));
  std::vector<Brought> runs(kPaths / kGrain);
  parallel_for(kPaths, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) follow(world, sharp, seed, static_cast<std::uint32_t>(i), runs[begin / kGrain]);
  });
  Brought all;
  for (const Brought& run : runs) all += run;
  SpecularShares shares{share_of(all, kSharp), share_of(all, kRough)};
  // What no material sends has no share, whatever the paths leave open.
  const auto has = [&](bool is_sharp_one) {
    return std::ranges::any_of(world.scene.instances, [&](const Instance& instance) {
      const std::uint32_t id = world.scene.meshes[instance.mesh].material;
      return !world.scene.materials[id].is_lambertian() && sharp[id] == is_sharp_one;
    });
  };
  if (!has(true)) shares.sharp = {};
  if (!has(false)) shares.rough = {};
  return shares;
}

}  // namespace radfarm
