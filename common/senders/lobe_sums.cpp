#include "senders/lobe_sums.h"

#include <algorithm>
#include <cmath>

namespace radfarm {

/// The bin of a direction on the octahedron.
std::size_t LobeSums::bin_of(const Vec3& d) {
  const float sum = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
  float x = d.x / sum, y = d.y / sum;
  if (d.z < 0) {
    const float folded_x = (1 - std::fabs(y)) * std::copysign(1.0F, x);
    y = (1 - std::fabs(x)) * std::copysign(1.0F, y);
    x = folded_x;
  }
  const auto bin = [](float t) { return std::clamp(static_cast<int>((t + 1) / 2 * kPerSide), 0, kPerSide - 1); };
  return static_cast<std::size_t>(bin(y) * kPerSide + bin(x));
}

void LobeSums::add(const Vec3& direction, const Spectrum& direct, const Spectrum& indirect) {
  Sum& sum = sums_[bin_of(direction)];
  sum.direction += to_double(direction) * static_cast<double>(luminance(direct) + luminance(indirect));
  sum.direct += SpectrumD(direct);
  sum.indirect += SpectrumD(indirect);
}

std::vector<Lobe> LobeSums::lobes() const {
  std::vector<Lobe> result;
  for (const Sum& sum : sums_) {
    if (!(length(sum.direction) > 0)) continue;
    result.push_back({to_float(normalize(sum.direction)), Spectrum(sum.direct), Spectrum(sum.indirect)});
  }
  return result;
}

}  // namespace radfarm
