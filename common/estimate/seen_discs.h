#pragma once

#include <cstdint>
#include <vector>

#include "estimate/eye_chain.h"
#include "estimate/photon_result.h"
#include "estimate/render_tile.h"
#include "paths/density.h"

namespace radfarm {

/// What of a disc's irradiance, lux, a pixel shows as radiance.
struct ShownDisc {
  std::uint32_t pixel = 0;
  Spectrum weight;
};

/// Discs on the diffuse surfaces that an image shows, by whatever mirrors and glass. docs/pipeline.md (paths.7)
struct SeenDiscs {
  std::vector<Disc> discs;
  std::vector<ShownDisc> shown;   // one a disc
  std::vector<float> footprints;  // m, one a disc: how far apart what a pixel sees lies there
};

struct SeenDiscSettings {
  std::uint32_t samples = 16;  // camera rays a pixel; those that look at one surface share a disc
  std::uint64_t photons = 0;   // paths that will be counted
  float radius = 0;            // m, of all; 0: each as wide as brings it `crossings` of the paths
  float crossings = 400;
  OriginSet origins = kAllOrigins;
  bool is_map = false;  // `crossings` are photons: for bring_photons()
};

/// Follows the eye chains of every pixel, then a pilot of light paths that decides radii: between the pixel's footprint
/// and a fiftieth of the scene. The same discs for any number of threads. Uses all of them: about 2 us a camera ray and
/// 20 us a disc.
SeenDiscs see_discs(const World& world, const Components& components, const Film& film,
                    const SeenDiscSettings& settings);

/// What a batch of light paths brings each pixel by its discs.
PhotonResult bring_light(const World& world, const DiscSet& set, std::span<const ShownDisc> shown, std::size_t pixels,
                         OriginSet origins, const PathBatch& batch);

/// What the photons that a batch of light paths leaves bring each pixel. (map.1) Keeps them, 40 bytes each.
PhotonResult bring_photons(const World& world, const SeenDiscs& seen, std::size_t pixels, OriginSet origins,
                           const PathBatch& batch);

/// An eye chain that sees no light on diffuse surfaces: emission, highlights, what mirrors show of emitters.
RadianceParts unlit_radiance(const World& world, const Ray& ray, const PixelSampler& sampler, Counters& counters,
                             FirstSurface* first);

}  // namespace radfarm
