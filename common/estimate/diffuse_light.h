#pragma once

#include <cstdint>

#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/scattering.h"

namespace radfarm {

/// Light that a diffuse surface receives (lux) or sends back (cd/m^2), direct and indirect apart.
struct Arrived {
  Spectrum direct;
  Spectrum indirect;
};

/// What the camera sees: the hit, the point there, turned to the viewer, and how it scatters.
struct SeenPoint {
  const Hit& hit;
  const SurfacePoint& point;
  const Bsdf& bsdf;
};

/// What an integrator tells the eye chain of the light at diffuse surfaces. Thread-safe.
class DiffuseLight {
 public:
  virtual ~DiffuseLight() = default;

  /// Irradiance, lux, of what the camera sees first, or by panes; less what the layers above its base keep.
  virtual Arrived seen(const SeenPoint& at, const PixelSampler& sampler, Counters& counters) const = 0;

  /// Radiance that the diffuse part of a vertex beyond sends along the path; `next_event` is one estimate of its direct part.
  /// Random numbers from `dimension` + 4 on are free.
  virtual Arrived beyond(const Hit& hit, const Vertex& vertex, const Spectrum& next_event, const PixelSampler& sampler,
                         std::uint32_t dimension, Counters& counters) const = 0;
};

}  // namespace radfarm
