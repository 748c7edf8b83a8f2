// What a target, and a tenth of the time for the audit, mean in counts.
#include <algorithm>
#include <cmath>

#include "pipeline/plan_audit.h"
#include "pipeline/resolve.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMostSamples = 64;  // times its first samples, of one pixel

// Audits: shares of what a render is expected to cost; for a target a little less than the quarter that all audits may take.
constexpr double kAuditShare = .1, kAuditShareOfTarget = .2;
constexpr std::uint32_t kLeastAudited = 512, kMostAudited = 16384;
// The audit's standard error that a first round needs, and the squared error it should find, as shares of the target's square.
constexpr double kErrorWanted = .5, kResolutionWanted = .18;
constexpr double kUneven = 2;  // how much more the pixels' noise is, in the root of its squares' mean, than in its mean

// Path tracing for a target: the mean scatter of pixels over the root of its mean square; the first samples of a pixel.
constexpr double kScatterOfMean = .7;
constexpr double kFirstPaths = 8, kLeastFirstPaths = 8, kMostFirstPaths = 1024;  // so many times less than the mean, within these

// Of a target of seconds: what a first round may be expected to take, and the highest of the costs that may turn out.
constexpr double kFirstShareOfTime = .4, kMostShareOfTime = 1.0;

double middle(const ExpectedCost& cost) { return std::sqrt(cost.low * cost.high); }

}  // namespace

float level_in_time(const RenderRequest& request, const World& world, const Camera& camera, const PathPilot& pilot, int threads) {
  const double seconds = request.time.value_or(0) * threads;
  float best = 0;
  for (float level = 0.25F; level <= kMostLevel; level += 0.25F) {
    Settings settings = resolve_settings(request, camera, {level, false, threads});
    settings.audit_pixels = 0;
    const ExpectedCost cost = expect_cost(world, settings, pilot, noise_share(request, settings));
    if (middle(cost) <= kFirstShareOfTime * seconds && cost.high <= kMostShareOfTime * seconds) best = level;
  }
  return best;
}

void resolve_audit(const RenderRequest& request, const World& world, const PathPilot& pilot, Settings& settings) {
  if (settings.audit_pixels == 0) return;
  const auto all = static_cast<std::uint32_t>(settings.width) * static_cast<std::uint32_t>(settings.height);
  Settings alone = settings;
  alone.audit_pixels = 0;
  // By counts and not by this machine's clock: what is audited is the same everywhere.
  const PathPilot counted = nominal(pilot);
  const ExpectedCost cost = expect_cost(world, alone, counted, noise_share(request, settings));
  if (!request.error) {
    // Of the low estimate: what noisy pixels may take more is seldom all of what is expected at most.
    const double pixels = kAuditShare / (1 - kAuditShare) * cost.low / counted.sample_seconds / (2.0 * settings.audit_samples);
    settings.audit_pixels = static_cast<std::uint32_t>(std::clamp(pixels, double{kLeastAudited}, double{kMostAudited}));
    return;
  }
  const double square = *request.error * *request.error, mean_squared = pilot.mean * pilot.mean;
  AuditNeeds needs;
  needs.mse = kErrorWanted * square;
  needs.path_variance = mean_squared > 0 ? kUneven * pilot.path_variance / mean_squared : 0;
  needs.most_error = kResolutionWanted * square;
  needs.most_paths = kAuditShareOfTarget / (1 - kAuditShareOfTarget) * middle(cost) / counted.sample_seconds;
  needs.all_pixels = all;
  const AuditPlan plan = plan_audit(needs);
  settings.audit_pixels = plan.pixels;
  settings.audit_samples = plan.samples;
}

void resolve_paths(const RenderRequest& request, const PathPilot& pilot, int threads, Settings& settings) {
  if (settings.integrator != Settings::Integrator::kPathTrace || request.samples) return;
  if (request.time) {
    const double pixels = static_cast<double>(settings.width) * settings.height;
    const double samples = kFirstShareOfTime * *request.time * threads / (pixels * std::max(pilot.sample_seconds, 1e-9));
    settings.camera_samples = settings.max_camera_samples = static_cast<std::uint32_t>(std::clamp(samples, 1.0, 65536.0));
  }
  if (!request.error || !(pilot.mean > 0) || !(pilot.path_variance > 0)) return;
  // A pixel of scatter s gets s / noise samples and keeps a variance of s noise: the target's share of the image's mean.
  const double scatter = kScatterOfMean * std::sqrt(pilot.path_variance);
  const double variance = kErrorWanted * *request.error * *request.error * pilot.mean * pilot.mean;
  settings.noise = static_cast<float>(variance / scatter);
  const double mean = scatter * scatter / variance;
  settings.camera_samples = static_cast<std::uint32_t>(std::clamp(mean / kFirstPaths, kLeastFirstPaths, kMostFirstPaths));
  settings.max_camera_samples = kMostSamples * settings.camera_samples;
}

}  // namespace radfarm
