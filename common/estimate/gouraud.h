#pragma once

#include "estimate/counters.h"
#include "estimate/first_surface.h"
#include "estimate/pixel_sampler.h"
#include "estimate/radiance_parts.h"
#include "radiosity/element_mesh.h"
#include "scene/camera.h"

namespace radfarm {

/// What a view that shows the radiosity solution borrows.
struct GouraudContext {
  const World& world;
  const ElementMesh& mesh;
  const SideNumbers& sides;
};

/// The radiosity solution as it is: L = L_e + rho(x) E(x) / pi, E linear in the element mesh, rho of the material at the very
/// point, so textures show. Mirrors, glass and gloss are followed as the gather does (eye_chain.h). A diffuse surface costs no ray;
/// its shadows are as sharp as the elements are small. Fills `first` where given.           docs/pipeline.md (mesh.3)
RadianceParts gouraud_radiance(const GouraudContext& context, const Ray& ray, const PixelSampler& sampler,
                               Counters& counters, FirstSurface* first = nullptr);

}  // namespace radfarm
