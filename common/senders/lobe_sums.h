#pragma once

#include <array>
#include <vector>

#include "senders/vertex_senders.h"

namespace radfarm {

/// Sums interpolated senders into lobes, 12 x 12 octahedral bins; each lobe's direction is the irradiance-weighted mean.
class LobeSums {
 public:
  /// Irradiance at normal incidence, lux, from a unit direction.
  void add(const Vec3& direction, const Spectrum& direct, const Spectrum& indirect);
  std::vector<Lobe> lobes() const;

 private:
  static constexpr int kPerSide = 12;
  struct Sum {
    Vec3d direction{0, 0, 0};
    SpectrumD direct, indirect;
  };
  static std::size_t bin_of(const Vec3& direction);
  std::array<Sum, kPerSide * kPerSide> sums_;
};

}  // namespace radfarm
