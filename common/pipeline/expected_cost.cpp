#include "pipeline/expected_cost.h"

#include "base/stopwatch.h"
#include "estimate/path_reference.h"
#include "estimate/render_tile.h"

namespace radfarm {
namespace {

constexpr int kPilotPixels = 4096;

// A gathered sample draws senders and form factors besides its rays: so many rays' time for each ray, roughly.
constexpr double kTimesRays = 1.75;
// To prepare: CPU seconds a triangle for its elements and links, and for the grid's vertices. The first differs most by scene; both were
// chosen to hold cornell and office, no more.
constexpr double kLowPerTriangle = 2e-5, kHighPerTriangle = 4e-4;
constexpr double kSenders = 3;
// What noisy pixels get beyond the first samples: 1.2 to 8 times on the scenes of docs/benchmarks.md.
constexpr double kMoreSamples = 8;
// Corners and what is added at borders [1].
constexpr double kPaperSamplesPerPixel = 2.5;

struct PilotCost {
  double sample_seconds = 0;
  double ray_seconds = 0;
};

PilotCost trace_pilot(const World& world, const Film& film) {
  Counters counters;
  const SampleRadiance path = [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) {
    return trace_path(world, ray, sampler, c);
  };
  const Stopwatch watch;
  for (int i = 0; i < kPilotPixels; ++i) {
    const int x = static_cast<int>((static_cast<long>(i) * 7919) % film.width);
    const int y = static_cast<int>(static_cast<long>(i) * film.height / kPilotPixels);
    (void)sample_pixel(film, Stream::kProbe, x, y, 0, 1, path, counters);
  }
  const double seconds = watch.cpu_seconds();
  const auto rays = static_cast<double>(counters.camera_rays + counters.path_rays + counters.visibility_rays);
  return {seconds / kPilotPixels, rays > 0 ? seconds / rays : 0};
}

/// Some five rays a path, as many searches for discs, and what discs count.
double photon_seconds(const Settings& settings, const PilotCost& pilot) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  return static_cast<double>(settings.photons) * 10 * pilot.ray_seconds + pixels * static_cast<double>(settings.photon_crossings) * 1e-7;
}

}  // namespace

ExpectedCost expect_cost(const World& world, const Camera& camera, const Settings& settings) {
  const PilotCost pilot = trace_pilot(world, {camera, settings.width, settings.height, settings.seed});
  ExpectedCost cost;
  cost.ray_seconds = pilot.ray_seconds;
  cost.audit = 2.0 * settings.audit_pixels * settings.audit_samples * pilot.sample_seconds;
  const double samples = static_cast<double>(settings.width) * settings.height * settings.camera_samples;
  if (settings.integrator == Settings::Integrator::kPathTrace) {
    cost.low = 0.8 * samples * pilot.sample_seconds + cost.audit;
    cost.high = 1.5 * samples * pilot.sample_seconds + cost.audit;
    return cost;
  }
  const double light = photon_seconds(settings, pilot);
  if (settings.is_by_photons()) {
    cost.low = 0.5 * light + samples * pilot.ray_seconds + cost.audit;
    cost.high = 3 * light + 20 * samples * pilot.ray_seconds + cost.audit;
    return cost;
  }
  double triangles = 0;
  for (const Instance& instance : world.scene.instances) {
    triangles += static_cast<double>(world.scene.meshes[instance.mesh].triangles.size());
  }
  if (settings.integrator == Settings::Integrator::kRadiosity) {
    // Most samples cost the camera's ray alone; where all is gloss, some ten more.
    cost.low = samples * pilot.ray_seconds + kLowPerTriangle * triangles + cost.audit;
    cost.high = 10 * samples * pilot.ray_seconds + kHighPerTriangle * triangles + cost.audit;
    return cost;
  }
  const bool is_paper = settings.senders.gather == Gather::kPaper;
  const double paper_rays = kPaperSamplesPerPixel * settings.width * settings.height *
                            static_cast<double>(settings.senders.paper_samples);
  const SenderSettings& senders = settings.senders;
  const double lines = static_cast<double>(senders.samples_per_gather);
  const double rays = is_paper ? paper_rays : samples * (1 + lines + senders.reflected_rays * (1 + senders.next_events));
  const double gather = rays * kTimesRays * pilot.ray_seconds;
  cost.low = 0.6 * gather + 0.5 * light + kLowPerTriangle * triangles + 0.5 * kSenders + cost.audit;
  const double most = settings.max_camera_samples > settings.camera_samples ? kMoreSamples : 1;
  cost.high = 1.7 * most * gather + 3 * light + kHighPerTriangle * triangles + 3 * kSenders + cost.audit;
  return cost;
}

}  // namespace radfarm
