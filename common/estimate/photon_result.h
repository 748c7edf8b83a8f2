#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/status.h"
#include "math/spectrum.h"

namespace radfarm {

/// Radiance that photon paths brought one pixel, cd/m^2 times the number of paths, by the class of the light.
struct PhotonPixel {
  Spectrum direct;
  Spectrum indirect;
  Spectrum specular;
  friend bool operator==(const PhotonPixel&, const PhotonPixel&) = default;
};

/// What a photon task returns: of a batch of paths, for the whole image.
struct PhotonResult {
  std::uint64_t paths = 0;
  std::vector<PhotonPixel> pixels;  // row by row
  friend bool operator==(const PhotonResult&, const PhotonResult&) = default;
};

/// Adds another batch, pixel by pixel. Requires: of the same image.
void add(const PhotonResult& more, PhotonResult& sum);

/// Flat file of kind "photons" (docs/formats.md). Hostile bytes give DATA_LOSS.
[[nodiscard]] std::vector<std::byte> encode(const PhotonResult& result);
Result<PhotonResult> decode_photon_result(std::span<const std::byte> bytes);

}  // namespace radfarm
