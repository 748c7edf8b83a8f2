#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimate/aov_sums.h"
#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/pixel_sums.h"
#include "estimate/sample_budget.h"
#include "estimate/sharing_sums.h"
#include "scene/camera.h"

namespace radfarm {

/// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// One sample of the radiance along a camera ray: what an integrator is to the farm. Fills the last argument where it is given.
using SampleRadiance = std::function<RadianceParts(const Ray&, const PixelSampler&, Counters&, FirstSurface*)>;

/// The emission that the same ray would see, if that is all that is asked; empty: the integrator has no cheaper way.
using SampleEmission = std::function<Spectrum(const Ray&, const PixelSampler&, Counters&)>;

/// A film and the random numbers that fall on it.
struct Film {
  Camera camera;
  int width = 0;
  int height = 0;
  std::uint64_t seed = 0;
  std::uint32_t cone_samples = 0;  // of a pixel, that share it as cones (pixel_cone); 0: rays are lines, no texture is filtered
};

/// Samples [first, first + count) of one pixel, by a box filter of one pixel. The same bits in any tile or pass.
PixelSums sample_pixel(const Film& film, Stream stream, int x, int y, std::uint32_t first, std::uint32_t count,
                       const SampleRadiance& radiance, Counters& counters);

/// What render_tile() keeps of a pixel besides its light.
struct Kept {
  bool aovs = false;
  bool sharing = false;  // then samples come in two halves that share no random number
};

/// A tile's pixels, row by row; what is not kept is empty.
struct TilePixels {
  std::vector<PixelSums> light;
  std::vector<AovSums> aovs;
  std::vector<SharingSums> sharing;
  std::vector<PixelNeeds> needs;  // of a budget by noise
};

/// sample_pixel for every pixel of a tile. How many samples a pixel gets is decided by those of its eight
/// neighbours, and not by its own: which samples a mean has must not depend on them, or it is biased towards what rare ones
/// lack. Neighbours beyond the tile's border are sampled as well, to the same bits as in their own tile.
/// Emission has no noise but at its edges: where neighbours' differs, the emission alone is sampled further, by the same rule;
/// complete_emission() adds what that finds.
TilePixels render_tile(const Film& film, const PixelRect& rect, const SampleBudget& budget, const SampleRadiance& radiance,
                       Counters& counters, const Kept& kept = {}, const SampleEmission& emission = {});

/// The same with a larger scale, going on from what a smaller one gave: the same bits as all at once.
/// Requires: `before` is of this rectangle, of the same budget but for its scale, and of what is kept.
TilePixels resume_tile(const Film& film, const PixelRect& rect, const SampleBudget& budget, const SampleRadiance& radiance,
                       Counters& counters, const Kept& kept, const SampleEmission& emission, const TilePixels& before);

}  // namespace radfarm
