#pragma once

#include <cstdint>

namespace radfarm {

/// What decides how well an audit measures. Errors and variances are shares of the image's mean squared.
struct AuditNeeds {
  double mse = 0;            // that is expected
  double spread = 5;         // standard deviation of pixels' squared errors, as a multiple of `mse`
  double path_variance = 0;  // of one path by a pixel: root of the mean over pixels of its square
  double most_error = 0;     // standard error of the measured MSE that would do
  double most_paths = 0;     // that it may cost, or about as many as the least useful audit
  std::uint32_t all_pixels = 1;
};

struct AuditPlan {
  std::uint32_t pixels = 0;
  std::uint32_t samples = 0;  // of each of the two estimates of one
  double error = 0;           // standard error of the measured MSE that is expected
  double paths() const { return 2.0 * pixels * samples; }
};

/// The cheapest audit that does, or else the one that measures best for `most_paths`.       docs/accuracy.md (audit.2)
AuditPlan plan_audit(const AuditNeeds& needs);

}  // namespace radfarm
