#include "estimate/gouraud.h"

#include "estimate/eye_chain.h"
#include "radiosity/element_point.h"

namespace radfarm {
namespace {

/// The element mesh's irradiance, wherever a path looks.
class MeshLight : public DiffuseLight {
 public:
  explicit MeshLight(const GouraudContext& context) : context_(context) {}

  Arrived seen(const SeenPoint& at, const PixelSampler&, Counters&) const override {
    return irradiance(at.hit, at.point);
  }
  Arrived beyond(const Hit& hit, const Vertex& vertex, const Spectrum&, const PixelSampler&, std::uint32_t,
                 Counters&) const override {
    const Arrived arrived = irradiance(hit, vertex.point);
    const Spectrum reflected = vertex.bsdf.diffuse_reflectance() * kInversePi;
    return {reflected * arrived.direct, reflected * arrived.indirect};
  }

 private:
  Arrived irradiance(const Hit& hit, const SurfacePoint& point) const {
    const ElementPoint at = locate(context_.mesh, context_.sides, context_.world.surfaces, hit, point);
    if (at.element == kNone) return {};
    const Irradiance found = interpolate(context_.mesh, at);
    return {found.direct, found.indirect};
  }

  const GouraudContext& context_;
};

}  // namespace

RadianceParts gouraud_radiance(const GouraudContext& context, const Ray& ray, const PixelSampler& sampler,
                               Counters& counters, FirstSurface* first) {
  const MeshLight light(context);
  return trace_eye_chain({context.world, light, true, first}, ray, sampler, counters);
}

}  // namespace radfarm
