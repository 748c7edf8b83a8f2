#include "paths/radius.h"

#include <algorithm>
#include <cmath>

namespace radfarm {

float choose_radius(const Disc& disc, const DiscSums& pilot, double pilot_paths, double paths, const RadiusRule& rule) {
  if (pilot.crossings == 0) return rule.most;
  const double expected = static_cast<double>(pilot.crossings) * paths / pilot_paths;
  const double radius = static_cast<double>(disc.shape.radius) * std::sqrt(rule.crossings / expected);
  return std::clamp(static_cast<float>(radius), std::min(rule.least, rule.most), rule.most);
}

double shrinking(std::uint64_t batch) { return std::pow(static_cast<double>(batch) + 1, -1.0 / 6); }

}  // namespace radfarm
