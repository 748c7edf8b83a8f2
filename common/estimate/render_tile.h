#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimate/counters.h"
#include "estimate/pixel_sampler.h"
#include "estimate/pixel_sums.h"
#include "scene/camera.h"

namespace radfarm {

/// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// One sample of the radiance along a camera ray: what an integrator is to the farm.
using SampleRadiance = std::function<RadianceParts(const Ray&, const PixelSampler&, Counters&)>;

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

/// sample_pixel for every pixel of a tile, row by row.
std::vector<PixelSums> render_tile(const Film& film, const PixelRect& rect, std::uint32_t samples,
                                   const SampleRadiance& radiance, Counters& counters);

}  // namespace radfarm
