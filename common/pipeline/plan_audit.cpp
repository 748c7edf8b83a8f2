#include "pipeline/plan_audit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace radfarm {
namespace {

constexpr std::uint32_t kLeastPixels = 512, kMostPixels = 16384;
constexpr double kLeastSamples = 16, kMostSamples = 65536;

AuditPlan plan_of(const AuditNeeds& needs, std::uint32_t pixels, double samples) {
  const double n = std::clamp(std::ceil(samples), kLeastSamples, kMostSamples);
  const double by_pixels = needs.spread * needs.mse, by_paths = needs.path_variance / n;
  return {pixels, static_cast<std::uint32_t>(n), std::sqrt((by_pixels * by_pixels + by_paths * by_paths) / pixels)};
}

/// Paths that bring the standard error down to what would do, or nothing where pixels are too few for that.
std::optional<AuditPlan> sufficient(const AuditNeeds& needs, std::uint32_t pixels) {
  const double by_pixels = needs.spread * needs.mse;
  const double left = needs.most_error * needs.most_error * pixels - by_pixels * by_pixels;
  if (!(left > 0)) return std::nullopt;
  const AuditPlan plan = plan_of(needs, pixels, needs.path_variance / std::sqrt(left));
  return plan.error <= needs.most_error * 1.001 ? std::optional(plan) : std::nullopt;
}

}  // namespace

AuditPlan plan_audit(const AuditNeeds& needs) {
  const std::uint32_t least = std::min(kLeastPixels, needs.all_pixels), most = std::min(kMostPixels, needs.all_pixels);
  std::optional<AuditPlan> cheapest, best;
  for (std::uint32_t pixels = least; pixels <= most; pixels *= 2) {
    const std::optional<AuditPlan> plan = sufficient(needs, pixels);
    if (plan && (!cheapest || plan->paths() < cheapest->paths())) cheapest = plan;
    const AuditPlan affordable = plan_of(needs, pixels, std::floor(needs.most_paths / (2.0 * pixels)));
    if (!best || (affordable.error < best->error && affordable.paths() <= needs.most_paths)) best = affordable;
  }
  return cheapest && cheapest->paths() <= needs.most_paths ? *cheapest : *best;
}

}  // namespace radfarm
