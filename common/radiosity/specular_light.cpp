#include "radiosity/specular_light.h"

#include "base/check.h"
#include "radiosity/direct.h"

namespace radfarm {
namespace {

const Spectrum& brought_to(const FirstLight& light, const SideNumbers& sides, const Patch& patch) {
  return light.specular[sides.of(patch.instance, patch.triangle, patch.is_front != 0)];
}

}  // namespace

std::vector<Spectrum> specular_irradiance(const FirstLight& light, const SideNumbers& sides, const Hierarchy& hierarchy) {
  RADFARM_CHECK(light.specular.empty() || light.specular.size() == sides.count);
  if (light.specular.empty()) return {};
  std::vector<Spectrum> irradiance(hierarchy.nodes.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (is_undivided(node)) irradiance[i] = brought_to(light, sides, hierarchy.patches[node.patch]);
  }
  return irradiance;
}

SpecularStarts::SpecularStarts(const FirstLight& light, const SideNumbers& sides, const Hierarchy& hierarchy)
    : world_(light.world), hierarchy_(hierarchy) {
  RADFARM_CHECK(light.specular.empty() || light.specular.size() == sides.count);
  if (light.specular.empty()) return;
  std::vector<double> power;
  for (const std::uint32_t leaf : hierarchy.leaves) {
    const Node& node = hierarchy.nodes[leaf];
    irradiance_.push_back(brought_to(light, sides, hierarchy.patches[node.patch]));
    power.push_back(luminance(SpectrumD(irradiance_.back())) * static_cast<double>(node.area));
  }
  choice_ = DiscreteDistribution(power);
}

SpecularArrival SpecularStarts::sample(double choice, const Vec2& place) const {
  const auto chosen = choice_.sample(choice);
  const Node& node = hierarchy_.nodes[hierarchy_.leaves[chosen.index]];
  const Patch& patch = hierarchy_.patches[node.patch];
  const SurfacePoint point = point_on_patch(world_, patch, place);
  const float coverage = world_.surfaces.coverage(world_.surfaces.hit_at(patch.instance, patch.triangle, point.position));
  return {point, world_.surfaces.reflectance(point) * coverage,
          irradiance_[chosen.index] * static_cast<float>(static_cast<double>(node.area) / chosen.probability)};
}

}  // namespace radfarm
