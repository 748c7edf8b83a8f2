#pragma once

#include <cstdint>

#include "base/random.h"
#include "math/sobol.h"
#include "math/vec.h"

namespace radfarm {

/// Streams of random numbers that must never share a number.
enum class Stream : std::uint64_t {
  kRender = 1, kAuditFirst = 2, kAuditSecond = 3, kRadiosity = 4, kSenders = 5, kProbe = 6, kCorner = 7,
  kRenderOdd = 8, kEmission = 9, kMeter = 10, kPhotonView = 11
};

/// The random numbers of one sample of one pixel: Owen-scrambled Sobol points, one 2-D sequence a dimension, keyed by
/// (seed, stream, pixel, dimension). Sample i of a pixel has the same numbers in whatever tile or pass it is drawn.
class PixelSampler {
 public:
  PixelSampler(std::uint64_t seed, Stream stream, int x, int y, std::uint32_t sample)
      : key_(combine(seed, static_cast<std::uint64_t>(stream), static_cast<std::uint64_t>(y),
                     static_cast<std::uint64_t>(x))),
        sample_(sample) {}

  Vec2 two(std::uint32_t dimension) const { return sobol_owen_2d(sample_, combine(key_, dimension)); }
  float one(std::uint32_t dimension) const { return sobol_owen_1d(sample_, combine(key_, dimension)); }
  /// For decisions that need no stratification, such as coverage along one ray.
  std::uint64_t key(std::uint32_t dimension) const { return combine(key_, dimension, sample_); }

 private:
  std::uint64_t key_;
  std::uint32_t sample_;
};

}  // namespace radfarm
