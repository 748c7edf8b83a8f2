#include "estimate/sky_light.h"

#include <algorithm>
#include <vector>

#include "scene/emitter_sampling.h"

namespace radfarm {
namespace {

/// What a patch is likely to give, luminance. A patch is wide: some of it may be above a horizon that its middle is below.
float likely_from(const GatherPoint& point, const SkyPatch& patch, float seen) {
  const float cosine = dot(point.surface.shading_normal, patch.direction);
  return patch.illuminance * seen * std::max(0.0F, cosine + patch.radius);
}

Spectrum line_to_sky(const GatherPoint& point, std::uint32_t patch, const Vec2& u) {
  const World& world = point.context.world;
  const EnvironmentLight::Sample sky = world.environment.sample_patch(patch, u);
  const float received = received_from(point, sky.direction);
  if (!(received > 0 && sky.pdf > 0) || !(dot(point.surface.geometric_normal, sky.direction) > 0)) return {};
  ++point.counters.visibility_rays;
  const Spectrum passed = world.caster.transmittance(point.start, beyond_scene(world, point.start, sky.direction));
  return sky.radiance * passed * (received / sky.pdf);
}

}  // namespace

Spectrum sky_light(const GatherPoint& point, std::span<const float> seen, std::uint32_t lines, std::uint32_t dimension) {
  const std::span<const SkyPatch> patches = point.context.world.environment.patches();
  thread_local std::vector<float> likely;  // scratch: one a patch
  likely.clear();
  float total = 0;
  for (std::size_t k = 0; k < patches.size(); ++k) total += likely.emplace_back(likely_from(point, patches[k], seen[k]));
  const float step = total / static_cast<float>(lines);
  if (!(step > 0)) return {};  // nothing, or so little that a line's share is no float
  float position = point.sampler.one(dimension) * step, until = 0;
  Spectrum sum;
  std::uint32_t line = 0;
  for (std::uint32_t k = 0; k < patches.size(); ++k) {
    until += likely[k];
    for (; position < until; position += step) {
      sum += line_to_sky(point, k, point.sampler.two(dimension + 1 + line++)) * (step / likely[k]);
    }
  }
  return sum;
}

}  // namespace radfarm
