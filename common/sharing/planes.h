#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimate/pixel_sums.h"
#include "estimate/sharing_sums.h"

namespace radfarm {

inline constexpr int kShareRadius = 6;   // pixels that share lie so far apart at most, along x and along y
inline constexpr int kPatchRadius = 2;   // of the patches by which their light is compared
// Below this mean albedo of a channel its light tells nothing of irradiance: the pixel keeps what it has there.
inline constexpr double kLeastAlbedo = 1e-3;

/// One number a pixel, with a border of kBorder pixels of zeros about the image, so that neighbours need no bounds.
using Plane = std::vector<float>;

/// The pixels of an image as sharing sees them: light as irradiance / pi, in two independent halves, and the surface they see.
struct Planes {
  static constexpr int kBorder = kShareRadius + kPatchRadius;
  struct Part {                                       // direct or indirect light
    std::array<std::array<Plane, 3>, 2> irradiance;   // by half and channel, of what the diffuse surface receives / pi, cd/m^2
    std::array<Plane, 2> luminance;                   // of a half
    Plane variance;                                   // of a half's luminance: the halves' difference, smoothed
  };
  int width = 0, height = 0;
  Plane shares;                     // 1 where a pixel sees a diffuse surface and no emitter, else 0
  std::array<Plane, 3> normal;      // unit
  std::array<Plane, 3> position;    // m
  Plane footprint;                  // distance of the nearest of the four neighbours' positions, m
  std::array<Part, 2> parts;        // direct, indirect

  int stride() const { return width + 2 * kBorder; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + kBorder) * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(x + kBorder);
  }
};

/// `pixels` and `sums` row by row. O(pixels).
Planes make_planes(int width, int height, std::span<const PixelSums> pixels, std::span<const SharingSums> sums);

}  // namespace radfarm
