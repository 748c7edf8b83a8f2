#pragma once

#include "estimate/diffuse_light.h"
#include "estimate/gather_context.h"
#include "estimate/scattering.h"

namespace radfarm {

/// What a look-up beside the grid needs besides the vertex.
struct OffGrid {
  const GatherContext& context;
  const PixelSampler& sampler;
  Counters& counters;
};

/// The diffuse part of a vertex beyond the first, where no grid is: `next_event`, and one ray that finds an emitter, the sky
/// or what the radiosity solution has there. Radiance, by class. Uses the random dimension `dimension` + 4.
Arrived light_off_grid(const OffGrid& at, const Vertex& vertex, const Spectrum& next_event, std::uint32_t dimension);

/// A gather whose light beyond what the camera sees is light_off_grid()'s.
class GridGather : public DiffuseLight {
 public:
  explicit GridGather(const GatherContext& context) : context_(context) {}

  Arrived beyond(const Hit&, const Vertex& vertex, const Spectrum& next_event, const PixelSampler& sampler,
                 std::uint32_t dimension, Counters& counters) const override {
    return light_off_grid({context_, sampler, counters}, vertex, next_event, dimension);
  }

 protected:
  const GatherContext& context_;
};

/// Irradiance of all punctual lights: up to 8 are traced each; of more, 8 are drawn by their unoccluded irradiance at the point. Uses
/// the random dimension 4.
Spectrum punctual_light(const GatherPoint& point);

}  // namespace radfarm
