#include "radiosity/escape.h"

#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kProbes = 4096;
constexpr std::uint64_t kEscapeKey = 0x657363;  // "esc"

}  // namespace

double probe_escaping(const World& world, const Hierarchy& hierarchy, std::uint64_t seed) {
  if (!(hierarchy.reflection_before.back() > 0)) return 0;
  const std::uint64_t key = combine(seed, kEscapeKey);
  std::uint32_t escaped = 0;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    const NodeSample from = sample_node(hierarchy, hierarchy.nodes[0], SampleBy::kReflectedPower,
                                        static_cast<double>(sobol_owen_1d(i, combine(key, 1))),
                                        sobol_owen_2d(i, combine(key, 2)));
    const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(i, combine(key, 3)));
    const Ray ray{from.leave(), normalize(Frame(from.normal).to_world(local))};
    if (!world.caster.closest(ray, combine(key, 4, i))) ++escaped;
  }
  return static_cast<double>(escaped) / kProbes;
}

}  // namespace radfarm
