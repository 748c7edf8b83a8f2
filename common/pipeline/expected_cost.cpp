#include "pipeline/expected_cost.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "estimate/path_reference.h"
#include "estimate/render_tile.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kPilotPixels = 2048, kPilotSamples = 2;
constexpr double kNominalRaySeconds = 5e-7;

// A gathered sample draws senders and form factors besides its rays: so many rays' time for each ray, roughly.
constexpr double kTimesRays = 1.75;
// To prepare at standard quality: CPU seconds a triangle for its elements and links, and for the grid's vertices. The first
// differs most by scene; both were chosen to hold cornell and office, no more. From quality to quality it doubles, about.
constexpr double kLowPerTriangle = 2e-5, kHighPerTriangle = 4e-4;
constexpr double kSenders = 3;
// Samples of a pixel times the share of noise that it may keep: 1.2 to 8 times the first samples on the scenes of
// docs/benchmarks.md.
constexpr double kLowSamples = 0.25, kHighSamples = 1.9;
// Corners and what is added at borders [1].
constexpr double kPaperSamplesPerPixel = 2.5;

struct Range {
  double low = 0, high = 0;
};

double pixels_of(const Settings& settings) { return static_cast<double>(settings.width) * settings.height; }

double triangles_of(const World& world) {
  double triangles = 0;
  for (const Instance& instance : world.scene.instances) {
    triangles += static_cast<double>(world.scene.meshes[instance.mesh].triangles.size());
  }
  return triangles;
}

Range preparation(const World& world, const Settings& settings) {
  const double triangles = triangles_of(world), times = std::exp2(static_cast<double>(settings.level) - 1);
  const double senders = settings.integrator == Settings::Integrator::kGather ? kSenders : 0;
  return {times * (kLowPerTriangle * triangles + 0.5 * senders), times * (kHighPerTriangle * triangles + 3 * senders)};
}

/// Of all pixels, with what noisy ones get beyond the first.
Range samples_of(const Settings& settings, float noise_share) {
  const double first = settings.camera_samples, most = settings.max_camera_samples, share = static_cast<double>(noise_share);
  if (!(share > 0) || most <= first) return {pixels_of(settings) * first, pixels_of(settings) * first};
  return {pixels_of(settings) * std::clamp(kLowSamples / share, first, most),
          pixels_of(settings) * std::clamp(kHighSamples / share, first, most)};
}

/// Of a sample of the gather, the camera's too.
double rays_of_gather(const SenderSettings& senders) {
  const double lines = static_cast<double>(senders.samples_per_gather);
  return 1 + lines + senders.reflected_rays * (1 + senders.next_events);
}

/// What tasks take for light, without the audit.
Range light(const Settings& settings, const PathPilot& pilot, float noise_share) {
  const Range samples = samples_of(settings, noise_share);
  // Some five rays a path, as many searches for discs (or places in a tree), and what discs count.
  const double paths = static_cast<double>(settings.photons) * 10 * pilot.ray_seconds +
                       pixels_of(settings) * static_cast<double>(settings.photon_crossings) * 1e-7;
  switch (settings.integrator) {
    case Settings::Integrator::kPathTrace:
      return {0.8 * samples.low * pilot.sample_seconds, 1.5 * samples.high * pilot.sample_seconds};
    case Settings::Integrator::kPaths:
    case Settings::Integrator::kPhotonMap:
      return {0.5 * paths + samples.low * pilot.ray_seconds, 3 * paths + 20 * samples.high * pilot.ray_seconds};
    case Settings::Integrator::kRadiosity:
      // Most samples cost the camera's ray alone; where all is gloss, some ten more.
      return {samples.low * pilot.ray_seconds, 10 * samples.high * pilot.ray_seconds};
    case Settings::Integrator::kGather:
      break;
  }
  const double a_ray = kTimesRays * pilot.ray_seconds;
  if (settings.senders.gather == Gather::kPaper) {
    const double rays = kPaperSamplesPerPixel * pixels_of(settings) * static_cast<double>(settings.senders.paper_samples);
    return {0.6 * rays * a_ray + 0.5 * paths, 1.7 * rays * a_ray + 3 * paths};
  }
  const double rays = rays_of_gather(settings.senders);
  return {0.6 * samples.low * rays * a_ray + 0.5 * paths, 1.7 * samples.high * rays * a_ray + 3 * paths};
}

}  // namespace

PathPilot trace_pilot(const World& world, const Camera& camera, const Settings& settings) {
  const Film film{camera, settings.width, settings.height, settings.seed};
  const SampleRadiance path = [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) {
    return trace_path(world, ray, sampler, c);
  };
  Counters counters;
  PathPilot pilot;
  const Stopwatch watch;
  for (std::uint32_t i = 0; i < kPilotPixels; ++i) {
    const int x = static_cast<int>((static_cast<long>(i) * 7919) % film.width);
    const int y = static_cast<int>(static_cast<long>(i) * film.height / kPilotPixels);
    const PixelSums sums = sample_pixel(film, Stream::kProbe, x, y, 0, kPilotSamples, path, counters);
    if (sums.samples < 2) continue;
    pilot.mean += luminance(sums.reflected()) / sums.samples / kPilotPixels;
    pilot.path_variance += variance_of_mean(sums) * sums.samples / kPilotPixels;
  }
  const double seconds = watch.cpu_seconds();
  const auto rays = static_cast<double>(counters.camera_rays + counters.path_rays + counters.visibility_rays);
  pilot.sample_seconds = seconds / (kPilotPixels * kPilotSamples);
  pilot.ray_seconds = rays > 0 ? seconds / rays : 0;
  pilot.rays = rays / (kPilotPixels * kPilotSamples);
  return pilot;
}

PathPilot nominal(const PathPilot& pilot) {
  PathPilot same = pilot;
  same.ray_seconds = kNominalRaySeconds;
  same.sample_seconds = pilot.rays * kNominalRaySeconds;
  return same;
}

ExpectedCost expect_cost(const World& world, const Settings& settings, const PathPilot& pilot, float noise_share) {
  const bool is_solved = settings.integrator == Settings::Integrator::kGather ||
                         settings.integrator == Settings::Integrator::kRadiosity;
  const Range before = is_solved ? preparation(world, settings) : Range();
  const Range tasks = light(settings, pilot, noise_share);
  ExpectedCost cost;
  cost.audit = 2.0 * settings.audit_pixels * settings.audit_samples * pilot.sample_seconds;
  cost.prepare = std::sqrt(before.low * before.high);
  cost.low = before.low + tasks.low + cost.audit;
  cost.high = before.high + tasks.high + cost.audit;
  return cost;
}

}  // namespace radfarm
