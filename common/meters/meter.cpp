#include "meters/meter.h"

#include <algorithm>
#include <limits>

#include "math/statistics.h"

namespace radfarm {

Summary summarise(std::span<const Reading> readings) {
  Summary s;
  s.points = readings.size();
  if (readings.empty()) return s;
  s.least = std::numeric_limits<double>::infinity();
  for (const Reading& reading : readings) {
    s.least = std::min(s.least, reading.lux());
    s.most = std::max(s.most, reading.lux());
    s.mean += reading.lux() / static_cast<double>(readings.size());
  }
  if (s.mean > 0) s.uniformity = s.least / s.mean;
  if (s.most > 0) s.diversity = s.least / s.most;
  for (const Reading& reading : readings) {
    if (reading.lux() > .01 * s.mean) s.widest = std::max(s.widest, reading.half_width / reading.lux());
  }
  return s;
}

double half_width_of(std::span<const double> replicates) {
  RunningStatistics statistics;
  for (const double value : replicates) statistics.add(value);
  return student_t_quantile(.975, static_cast<int>(replicates.size()) - 1) * statistics.standard_error();
}

}  // namespace radfarm
