#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/spectrum.h"
#include "math/vec.h"

namespace radfarm {

/// A light meter: measures the light that arrives at a point in space from the side that its normal shows. In the
/// scene's own, recentred coordinates.
struct Meter {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 1, 0};  // unit
};

/// What it reads.
struct Reading {
  SpectrumD irradiance;       // lux, photometric RGB
  double half_width = 0;      // of the 95 % interval of the illuminance, lux
  std::uint64_t samples = 0;  // paths that were counted

  double lux() const { return luminance(irradiance); }
};

/// What standards ask of the readings of an area (EN 12464-1: U0 = least / mean).
struct Summary {
  std::size_t points = 0;
  double least = 0, mean = 0, most = 0;  // lux
  double uniformity = 0;                 // least / mean; 0 in the dark
  double diversity = 0;                  // least / most; 0 in the dark
  double widest = 0;  // half width of a 95 % interval over its reading; the largest, of readings above 1 % of the mean
};
Summary summarise(std::span<const Reading> readings);

/// Half the width of a 95 % interval of the mean of independent replicates. Requires: at least 2.
double half_width_of(std::span<const double> replicates);

/// Replicates that share no random number: what an interval is made of.
inline constexpr std::size_t kReplicates = 16;

}  // namespace radfarm
