#include <nlohmann/json.hpp>

#include "frame/assemble.h"
#include "frame/audit.h"
#include "frame/tasks.h"
#include "frame/view.h"
#include "base/stopwatch.h"
#include "image/digest.h"
#include "pipeline/pipeline.h"
#include "sharing/share_light.h"

namespace radfarm {
namespace {

using nlohmann::json;

// A sample in a hundred thousand may be lost to rounding at an edge; more means that something is wrong.
constexpr double kMaxDroppedShare = 1e-5;

struct Decoded {
  std::vector<TileResult> tiles;
  std::vector<AuditResult> audits;
};

Result<Decoded> decode_results(const std::vector<Task>& tasks, std::span<const std::vector<std::byte>> results) {
  if (results.size() != tasks.size()) return fail(Code::kDataLoss, "results are missing");
  Decoded decoded;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (tasks[i].kind == Task::Kind::kTile) {
      RADFARM_TRY(TileResult tile, decode_tile_result(results[i]));
      decoded.tiles.push_back(std::move(tile));
    } else {
      RADFARM_TRY(AuditResult audited, decode_audit_result(results[i]));
      decoded.audits.push_back(std::move(audited));
    }
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

/// The stage "sharing".
void share(const Settings& settings, Raster& raster, json& facts) {
  const Stopwatch watch;
  share_light(settings.width, settings.height, raster.sharing, raster.pixels, raster.aovs);
  facts["stages"].push_back({{"name", "sharing"}, {"wall_s", watch.wall_seconds()}, {"cpu_s", watch.cpu_seconds()}});
}

}  // namespace

Result<Finished> finish(std::span<const std::byte> view, std::span<const std::vector<std::byte>> results,
                        const FarmFacts& farm) {
  RADFARM_TRY(const View opened, decode_view(view));
  const Settings& settings = opened.settings;
  RADFARM_TRY(const Decoded decoded, decode_results(cut_tasks(settings), results));
  RADFARM_TRY(Raster raster, assemble(settings, decoded.tiles));
  if (dropped_share(raster) > kMaxDroppedShare) {
    return fail(Code::kInternal, "a share of " + std::to_string(dropped_share(raster)) +
                                     " of all samples was not finite or negative; the limit is " +
                                     std::to_string(kMaxDroppedShare));
  }
  json facts = json::parse(opened.facts, nullptr, /*allow_exceptions=*/false);
  if (!facts.is_object()) return fail(Code::kDataLoss, "view: its facts are not JSON");
  raster.elevation = opened.elevation;
  if (settings.shares_light != 0) share(settings, raster, facts);
  std::optional<Accuracy> accuracy;
  Counters counters = raster.counters;
  if (settings.audit_pixels > 0) {
    RADFARM_TRY(accuracy, audit(settings, raster, decoded.audits));
    for (const AuditResult& audited : decoded.audits) counters.dropped_samples += audited.counters.dropped_samples;
  }
  Finished finished;
  finished.image = to_image(settings, raster);
  finished.report = std::make_unique<json>(make_report(std::move(facts), settings, raster, counters, accuracy,
                                                       image_digest(finished.image), farm));
  add_attributes(finished.image, *finished.report);
  return finished;
}

}  // namespace radfarm
