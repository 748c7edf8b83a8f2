#include "estimate/aov_sums.h"

namespace radfarm {

void AovSums::add_cost(const Counters& before, const Counters& after) {
  camera_rays += after.camera_rays - before.camera_rays;
  visibility_rays += after.visibility_rays - before.visibility_rays;
  form_factor_samples += after.form_factor_samples - before.form_factor_samples;
}

void AovSums::add(const FirstSurface& seen, float seen_depth) {
  if (!seen.is_seen) return;
  albedo += SpectrumD(seen.albedo);
  normal += to_double(seen.normal);
  irradiance += SpectrumD(seen.irradiance);
  depth += static_cast<double>(seen_depth);
  threshold += static_cast<double>(seen.threshold);
  // Numbers of cells have no mean.
  if (hits == 0) {
    cell = seen.cell;
    vertex = seen.vertex;
  }
  ++hits;
  const std::uint32_t total = seen.classes.total();
  if (total == 0) return;
  const std::array<std::uint32_t, 4> counts = {seen.classes.interpolated, seen.classes.form_factor, seen.classes.visibility,
                                               seen.classes.both};
  for (std::size_t k = 0; k < counts.size(); ++k) classes[k] += static_cast<double>(counts[k]) / total;
  ++classified;
}

}  // namespace radfarm
