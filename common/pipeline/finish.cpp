#include <numeric>

#include <nlohmann/json.hpp>

#include "frame/assemble.h"
#include "frame/audit.h"
#include "frame/light_layers.h"
#include "frame/tasks.h"
#include "frame/view.h"
#include "base/stopwatch.h"
#include "image/digest.h"
#include "pipeline/pipeline.h"
#include "pipeline/stage_clock.h"
#include "sharing/share_light.h"

namespace radfarm {
namespace {

using nlohmann::json;

// A sample in a hundred thousand may be lost to rounding at an edge; more means that something is wrong.
constexpr double kMaxDroppedShare = 1e-5;

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

void add_attributes(Image& image, const json& report) {
  const auto text = [&](const char* pointer) {
    const json::json_pointer at(pointer);
    return report.contains(at) && report[at].is_string() ? report[at].get<std::string>() : std::string();
  };
  image.attributes["radfarm.scene_digest"] = text("/scene/digest");
  image.attributes["radfarm.solution_digest"] = text("/solution/digest");
  image.attributes["radfarm.settings"] = report["settings"]["resolved"].dump();
  image.attributes["radfarm.build"] = RADFARM_VERSION;
  image.attributes["radfarm.accuracy"] = report["accuracy"].dump();
}

/// A light's image, pixels having shared it.
Result<Raster> raster_of(const View& view, std::span<const std::vector<std::byte>> results, json& stages) {
  RADFARM_TRY(const std::vector<TileResult> tiles, decode_results(results, decode_tile_result));
  RADFARM_TRY(Raster raster, assemble(view.settings, tiles));
  raster.elevation = view.elevation;
  if (view.settings.shares_light == 0) return raster;
  const Stopwatch watch;
  share_light(view.settings.width, view.settings.height, raster.sharing, raster.pixels, raster.aovs);
  StageClock::add(stages, "sharing", watch);
  return raster;
}

double mean_reflected(const Raster& raster) {
  double sum = 0;
  for (const PixelSums& pixel : raster.pixels) sum += luminance(pixel.reflected() / static_cast<double>(pixel.samples));
  return sum / static_cast<double>(raster.pixels.size());
}

/// All light: of one image, or added up over light groups, whose layers go to `layers`, their shares to the facts. One after the
/// other, as their sums need ten times the memory of their layers.
Result<Raster> add_lights(std::span<const View> views, std::span<const std::vector<std::byte>> results, json& facts,
                          Image& layers) {
  const std::size_t tiles = tile_count(views[0].settings), batches = views[0].settings.photon_batches;
  Raster sum;
  std::vector<double> means;
  for (std::size_t i = 0; i < views.size(); ++i) {
    RADFARM_TRY(Raster raster, raster_of(views[i], results.subspan(i * tiles, tiles), facts["stages"]));
    RADFARM_TRY(const std::vector<PhotonResult> photons,
                decode_results(results.subspan(views.size() * tiles + i * batches, batches), decode_photon_result));
    RADFARM_TRY_STATUS(add_photons(photons, raster));
    if (!views[i].light_group.empty()) add_light_layer(views[i].light_group, raster, layers);
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
  return sum;
}

/// What of the settings of light groups is not the first one's.
json resolved_light_groups(std::span<const View> views) {
  json rows = json::array();
  for (const View& view : views) {
    const Settings& s = view.settings;
    rows.push_back({{"name", view.light_group}, {"seed", s.seed}, {"noise", s.noise}, {"threshold", s.senders.threshold}});
  }
  return rows;
}

Result<Raster> checked(Raster raster) {
  if (!(dropped_share(raster) > kMaxDroppedShare)) return raster;
  return fail(Code::kInternal, "a share of " + std::to_string(dropped_share(raster)) +
                                   " of all samples was not finite or negative; the limit is " +
                                   std::to_string(kMaxDroppedShare));
}

}  // namespace

Result<Finished> finish(std::span<const std::byte> view, std::span<const std::vector<std::byte>> results,
                        const FarmFacts& farm) {
  RADFARM_TRY(const std::vector<View> views, decode_views(view));
  const Settings& settings = views[0].settings;
  const std::size_t images = views.size() * (tile_count(settings) + settings.photon_batches);  // tasks of light
  if (results.size() != cut_tasks(settings, views.size()).size()) return fail(Code::kDataLoss, "results are missing");
  RADFARM_TRY(const std::vector<AuditResult> audits, decode_results(results.subspan(images), decode_audit_result));
  json facts = json::parse(views[0].facts, nullptr, /*allow_exceptions=*/false);
  if (!facts.is_object()) return fail(Code::kDataLoss, "view: its facts are not JSON");
  Image layers;
  RADFARM_TRY(Raster sum, add_lights(views, results.first(images), facts, layers));
  RADFARM_TRY(const Raster raster, checked(std::move(sum)));
  std::optional<Accuracy> accuracy;
  Counters counters = raster.counters;
  if (settings.audit_pixels > 0) {
    RADFARM_TRY(accuracy, audit(settings, raster, audits));
    for (const AuditResult& audited : audits) counters.dropped_samples += audited.counters.dropped_samples;
  }
  Finished finished;
  finished.image = to_image(settings, raster);
  finished.image.channels.merge(layers.channels);
  finished.report = std::make_unique<json>(make_report(std::move(facts), settings, raster, counters, accuracy,
                                                       image_digest(finished.image), farm));
  if (!views[0].light_group.empty()) {
    (*finished.report)["settings"]["resolved"]["light_groups"] = resolved_light_groups(views);
  }
  add_attributes(finished.image, *finished.report);
  return finished;
}

}  // namespace radfarm
