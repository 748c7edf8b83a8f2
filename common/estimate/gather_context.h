#pragma once

#include <algorithm>

#include "estimate/counters.h"
#include "estimate/diffuse_light.h"
#include "estimate/pixel_sampler.h"
#include "scene/world.h"
#include "senders/sender_grid.h"
#include "senders/reflector_lookup.h"

namespace radfarm {

/// What every gather of a view borrows.
struct GatherContext {
  const World& world;
  const SenderTree& tree;
  const ReflectorLookup& lookup;
  const SenderGrid& senders;
  const SenderSettings& settings;
  bool has_interreflection = true;  // effect interreflection; off: `indirect` is neither computed nor returned
};

/// One visible point and all that its gather needs.
struct GatherPoint {
  const GatherContext& context;
  const SurfacePoint& surface;
  const Bsdf& bsdf;
  const PixelSampler& sampler;
  Counters& counters;
  Vec3 start{0, 0, 0};      // where rays leave it
  float near_distance = 0;  // m: closer reflecting surfaces come by rays, not from senders
};

/// How much of the irradiance from a unit direction at normal incidence the diffuse part scatters: the cosine, and what its
/// layers let through.
inline float received_from(const GatherPoint& point, const Vec3& direction) {
  const float cosine = dot(point.surface.shading_normal, direction);
  return cosine > 0 ? cosine * point.bsdf.diffuse_shape(direction) : 0;
}

inline float cosine_to(const GatherPoint& point, const Vec3& direction) {
  return std::max(0.0F, dot(point.surface.shading_normal, direction));
}

}  // namespace radfarm
