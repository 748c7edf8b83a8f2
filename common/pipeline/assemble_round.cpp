#include <cmath>
#include <numeric>
#include <utility>

#include "base/stopwatch.h"
#include "frame/assemble.h"
#include "frame/audit.h"
#include "frame/light_layers.h"
#include "frame/tasks.h"
#include "pipeline/assembled.h"
#include "pipeline/stage_clock.h"
#include "sharing/share_light.h"

namespace radfarm {
namespace {

using nlohmann::json;

// A sample in a hundred thousand may be lost to rounding at an edge; more means that something is wrong.
constexpr double kMaxDroppedShare = 1e-5;

// The scales that a next round may have: times that of this one.
constexpr double kMostGrowth = 16;
constexpr double kGrowthStep = 1.189207115002721;  // 2^(1/4)

// What is done at the end of a ray, in rays of a path tracer: the gather's draw senders and form factors; photon paths look for
// discs.
constexpr double kGatheredRay = 1.75, kPhotonPath = 10;

/// Results of `tasks`, decoded by `decode`.
template <typename T>
Result<std::vector<T>> decode_results(std::span<const std::vector<std::byte>> results,
                                      Result<T> (*decode)(std::span<const std::byte>)) {
  std::vector<T> decoded;
  for (const std::vector<std::byte>& bytes : results) {
    RADFARM_TRY(T result, decode(bytes));
    decoded.push_back(std::move(result));
  }
  return decoded;
}

/// A light's image, pixels having shared it.
Result<Raster> raster_of(const View& view, std::span<const std::vector<std::byte>> results, json& stages) {
  RADFARM_TRY(const std::vector<TileResult> tiles, decode_results(results, decode_tile_result));
  RADFARM_TRY(Raster raster, assemble(view.settings, tiles));
  raster.elevation = view.elevation;
  if (view.settings.shares_light == 0) return raster;
  const Stopwatch watch;
  raster.noise = share_light(view.settings.width, view.settings.height, raster.sharing, raster.pixels, raster.aovs);
  StageClock::add(stages, "sharing", watch);
  return raster;
}

double mean_reflected(const Raster& raster) {
  double sum = 0;
  for (const PixelSums& pixel : raster.pixels) sum += luminance(pixel.reflected() / static_cast<double>(pixel.samples));
  return sum / static_cast<double>(raster.pixels.size());
}

/// What noise the pixels keep, where sharing has not told it.
void add_noise(Raster& raster) {
  if (!raster.noise.empty()) return;
  for (const PixelSums& pixel : raster.pixels) raster.noise.push_back(noise_of(pixel));
}

/// Camera samples of a pixel at a scale, or passes of photon paths.
double samples_at(const Settings& settings, const Round& round, const PixelNeeds& needs) {
  if (settings.is_by_photons()) return photon_passes(round);
  return samples_of(budget_of(settings, round), needs);
}

/// Adds what a light's pixels would keep of noise at each scale, (cd/m^2)^2, and what that takes.
void add_noise_curve(const Settings& settings, const Round& round, const Raster& raster, std::vector<NoiseAt>& curve) {
  const double pixels = static_cast<double>(raster.pixels.size());
  for (NoiseAt& at : curve) {
    Round further = round;
    further.scale = at.scale;
    for (std::size_t i = 0; i < raster.pixels.size(); ++i) {
      const PixelNeeds needs = raster.needs.empty() ? PixelNeeds() : raster.needs[i];
      const double now = samples_at(settings, round, needs), then = samples_at(settings, further, needs);
      at.noise += static_cast<double>(raster.noise[i]) * now / then / pixels;
      at.samples += then / pixels;
    }
  }
}

/// All light: of one image, or added up over light groups, whose layers go to `layers`, their shares to the facts. One after the
/// other, as their sums need ten times the memory of their layers.
Status add_lights(const Round& round, std::span<const std::vector<std::byte>> results, AssembledRound::Parts& parts) {
  const std::vector<View>& views = parts.views;
  json& facts = parts.facts;
  const std::size_t tiles = tile_count(views[0].settings), batches = views[0].settings.photon_batches;
  Raster& sum = parts.raster;
  std::vector<double> means;
  for (std::size_t i = 0; i < views.size(); ++i) {
    RADFARM_TRY(Raster raster, raster_of(views[i], results.subspan(i * tiles, tiles), facts["stages"]));
    RADFARM_TRY(const std::vector<PhotonResult> photons,
                decode_results(results.subspan(views.size() * tiles + i * batches, batches), decode_photon_result));
    RADFARM_TRY_STATUS(add_photons(photons, raster));
    add_noise(raster);
    add_noise_curve(views[i].settings, round, raster, parts.figures.noise);
    if (!views[i].light_group.empty()) add_light_layer(views[i].light_group, raster, parts.layers);
    means.push_back(mean_reflected(raster));
    if (i == 0) {
      sum = std::move(raster);
    } else {
      add_light_group(raster, sum);
    }
  }
  const double all = std::accumulate(means.begin(), means.end(), 0.0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].light_group.empty()) facts["light_groups"][i]["share_of_image"] = all > 0 ? json(means[i] / all) : json();
  }
  return {};
}

Status check_dropped(const Raster& raster) {
  if (!(dropped_share(raster) > kMaxDroppedShare)) return {};
  return fail(Code::kInternal, "a share of " + std::to_string(dropped_share(raster)) +
                                   " of all samples was not finite or negative; the limit is " +
                                   std::to_string(kMaxDroppedShare));
}

std::vector<NoiseAt> scales(const Settings& settings, const Round& round) {
  std::vector<NoiseAt> curve;
  const bool is_whole = settings.is_by_photons();
  for (double growth = 1; growth <= kMostGrowth * 1.0001; growth *= kGrowthStep) {
    const double scale = is_whole ? std::ceil(round.scale * growth - 1e-9) : round.scale * growth;
    if (curve.empty() || scale > curve.back().scale) curve.push_back({scale, 0, 0});
  }
  return curve;
}

double rays_of(const Counters& c) { return static_cast<double>(c.camera_rays + c.path_rays + c.visibility_rays); }

double light_work(const Settings& settings, const Counters& c) {
  const double a_ray = settings.integrator == Settings::Integrator::kGather ? kGatheredRay : 1;
  return a_ray * rays_of(c) + kPhotonPath * static_cast<double>(c.photon_paths);
}

/// All that depends on results.
Status add_results(const Round& round, std::span<const std::vector<std::byte>> results, AssembledRound::Parts& parts) {
  const Settings& settings = parts.views[0].settings;
  const std::size_t images = parts.views.size() * (tile_count(settings) + settings.photon_batches);  // tasks of light
  const std::size_t tasks = cut_tasks(settings, round, parts.views.size()).size();
  if (results.size() != tasks) return fail(Code::kDataLoss, "results are missing");
  RADFARM_TRY(const std::vector<AuditResult> audits, decode_results(results.subspan(images), decode_audit_result));
  RADFARM_TRY_STATUS(add_lights(round, results.first(images), parts));
  RADFARM_TRY_STATUS(check_dropped(parts.raster));
  RoundFigures& figures = parts.figures;
  parts.counters = parts.raster.counters;
  figures.light_work = light_work(settings, parts.counters);
  if (round.audit_pixels == 0) return {};
  RADFARM_TRY(figures.accuracy, audit(settings, round, parts.raster, audits));
  for (const AuditResult& audited : audits) {
    parts.counters.dropped_samples += audited.counters.dropped_samples;
    figures.audit_work += rays_of(audited.counters);
  }
  return {};
}

/// From (cd/m^2)^2 to shares of the mean squared.
void relate_noise(const Raster& raster, RoundFigures& figures) {
  const double mean = figures.accuracy ? figures.accuracy->mean : mean_reflected(raster);
  for (NoiseAt& at : figures.noise) at.noise = mean > 0 ? at.noise / (mean * mean) : 0;
}

}  // namespace

AssembledRound::AssembledRound(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
AssembledRound::AssembledRound(AssembledRound&&) noexcept = default;
AssembledRound& AssembledRound::operator=(AssembledRound&&) noexcept = default;
AssembledRound::~AssembledRound() = default;
const RoundFigures& AssembledRound::figures() const { return parts_->figures; }

Result<AssembledRound> assemble_round(std::span<const std::byte> view, const Round& round,
                                      std::span<const std::vector<std::byte>> results) {
  auto parts = std::make_unique<AssembledRound::Parts>();
  RADFARM_TRY(parts->views, decode_views(view));
  for (View& one : parts->views) one.grid = {};
  const Settings& settings = parts->views[0].settings;
  parts->facts = json::parse(parts->views[0].facts, nullptr, /*allow_exceptions=*/false);
  if (!parts->facts.is_object()) return fail(Code::kDataLoss, "view: its facts are not JSON");
  RoundFigures& figures = parts->figures;
  figures.round = round;
  figures.integrator = settings.integrator;
  figures.level = settings.level;
  figures.target_error = settings.target_error;
  figures.pixels = static_cast<std::uint32_t>(settings.width) * static_cast<std::uint32_t>(settings.height);
  figures.noise = scales(settings, round);
  for (const json& stage : parts->facts.value("stages", json::array())) {
    if (!stage.is_object()) continue;
    figures.prepare_cpu_seconds += stage.value("cpu_s", 0.0);
    figures.prepare_wall_seconds += stage.value("wall_s", 0.0);
  }
  RADFARM_TRY_STATUS(add_results(round, results, *parts));
  relate_noise(parts->raster, figures);
  return AssembledRound(std::move(parts));
}

}  // namespace radfarm
