#include <algorithm>

#include "image/digest.h"
#include "pipeline/assembled.h"
#include "pipeline/rounds_report.h"

namespace radfarm {
namespace {

using nlohmann::json;

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

/// What of the settings of light groups is not the first one's.
json resolved_light_groups(std::span<const View> views) {
  json rows = json::array();
  for (const View& view : views) {
    const Settings& s = view.settings;
    rows.push_back({{"name", view.light_group}, {"seed", s.seed}, {"noise", s.noise}, {"threshold", s.senders.threshold}});
  }
  return rows;
}

}  // namespace

Finished finish(AssembledRound round, JobFacts job) {
  AssembledRound::Parts& parts = round.parts();
  const Settings& settings = parts.views[0].settings;
  if (job.rounds.empty()) job.rounds.push_back(parts.figures);
  Finished finished;
  finished.image = to_image(settings, parts.raster);
  finished.image.channels.merge(parts.layers.channels);
  finished.report = std::make_unique<json>(make_report(std::move(parts.facts), settings, parts.raster, parts.counters,
                                                       parts.figures.accuracy, image_digest(finished.image), job.farm));
  json& report = *finished.report;
  if (!parts.views[0].light_group.empty()) report["settings"]["resolved"]["light_groups"] = resolved_light_groups(parts.views);
  add_rounds(job, report);
  add_attributes(finished.image, report);
  return finished;
}

Result<Finished> finish(std::span<const std::byte> view, std::span<const std::vector<std::byte>> results,
                        const FarmFacts& farm) {
  RADFARM_TRY(const Round round, first_round(view));
  RADFARM_TRY(AssembledRound assembled, assemble_round(view, round, results));
  return finish(std::move(assembled), {farm, {}, {}, {}, 0});
}

}  // namespace radfarm
