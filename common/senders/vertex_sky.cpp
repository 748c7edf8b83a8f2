#include "senders/vertex_sky.h"

#include "base/random.h"
#include "math/sobol.h"
#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kLines = 6;
// A patch that the vertex's lines saw hidden is sampled as if this share of it were seen.
constexpr float kLeastSeen = 0.25F;

}  // namespace

std::vector<float> visible_sky(const World& world, std::span<const ReceiverPoint> receivers, std::uint64_t key) {
  std::vector<float> seen;
  const auto patches = static_cast<std::uint32_t>(world.environment.patches().size());
  seen.reserve(patches);
  for (std::uint32_t k = 0; k < patches; ++k) {
    float passed = 0, above = 0;
    for (std::uint32_t i = 0; i < kLines; ++i) {
      const ReceiverPoint& x = receivers[(k + i * receivers.size() / kLines) % receivers.size()];
      const Vec3 way = world.environment.sample_patch(k, sobol_owen_2d(i, combine(key, k))).direction;
      const bool is_above = x.normal == Vec3(0, 0, 0) || dot(x.normal, way) > 0;
      if (!is_above) continue;
      ++above;
      passed += luminance(world.caster.transmittance(x.position, beyond_scene(world, x.position, way)));
    }
    seen.push_back(above > 0 ? kLeastSeen + (1 - kLeastSeen) * passed / above : 1);
  }
  return seen;
}

}  // namespace radfarm
