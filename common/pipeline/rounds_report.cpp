#include "pipeline/rounds_report.h"

#include <cmath>

#include "pipeline/next_round.h"

namespace radfarm {
namespace {

using nlohmann::json;

const char* name_of(RoundFigures::Kind kind) {
  switch (kind) {
    case RoundFigures::Kind::kFirst: return "first";
    case RoundFigures::Kind::kMoreSamples: return "more samples";
    case RoundFigures::Kind::kNewLight: return "new light";
  }
  return "";
}

json round_json(const Round& round) {
  return {{"number", round.number}, {"scale", round.scale}, {"audit_pixels", round.audit_pixels},
          {"audit_samples", round.audit_samples}};
}

/// What of a round's settings is not that of the one before.
json changes(const RoundFigures& now, const RoundFigures* before) {
  json settings = {{"scale", now.round.scale},
                   {"level", now.level},
                   {"paths_alone", now.integrator == Settings::Integrator::kPathTrace},
                   {"audit_pixels", now.round.audit_pixels}, {"audit_samples", now.round.audit_samples}};
  if (before == nullptr) return settings;
  const json old = changes(*before, nullptr);
  for (const auto& [key, value] : old.items()) {
    if (settings[key] == value) settings.erase(key);
  }
  return settings;
}

json row_of(const RoundFigures& f, const RoundFigures* before) {
  json row = {{"kind", name_of(f.kind)}, {"settings", changes(f, before)}, {"samples", f.noise[0].samples},
              {"noise", std::sqrt(f.noise[0].noise)}, {"relative_rmse", nullptr}, {"ci95", nullptr},
              {"cpu_s", f.prepare_cpu_seconds + f.light_cpu_seconds + f.audit_cpu_seconds}, {"audit_cpu_s", f.audit_cpu_seconds},
              {"wall_s", f.prepare_wall_seconds + f.wall_seconds}};
  if (!f.accuracy || !f.accuracy->relative_rmse) return row;
  const MeasuredError& error = *f.accuracy->relative_rmse;
  if (error.value) row["relative_rmse"] = *error.value;
  row["ci95"] = {error.lower, error.upper};
  return row;
}

json target_json(const Target& target) { return target.error > 0 ? json(target.error) : json(); }

}  // namespace

void add_rounds(const JobFacts& job, json& report) {
  double cpu = 0, audit = 0;
  report["rounds"] = json::array();
  for (std::size_t i = 0; i < job.rounds.size(); ++i) {
    const RoundFigures& f = job.rounds[i];
    report["rounds"].push_back(row_of(f, i > 0 ? &job.rounds[i - 1] : nullptr));
    cpu += f.prepare_cpu_seconds + f.light_cpu_seconds + f.audit_cpu_seconds;
    audit += f.audit_cpu_seconds;
  }
  json& accuracy = report["accuracy"];
  accuracy["target"] = target_json(job.target);
  accuracy["target_met"] = job.target_met ? json(*job.target_met) : json();
  accuracy["audit_cpu_share"] = cpu > 0 ? json(audit / cpu) : json();
  report["settings"]["resolved"]["round"] = round_json(job.rounds.back().round);
  report["next_halving"] = nullptr;
  if (const std::optional<NextHalving> halving = next_halving(job.rounds)) {
    report["next_halving"] = {{"cpu_s", halving->cpu_seconds}, {"wall_s", halving->wall_seconds}, {"from", halving->from}};
  }
  if (!(job.target.seconds > 0)) return;
  report["time"] = {{"target_s", job.target.seconds}, {"elapsed_s", job.elapsed_seconds}};
  report["warnings"].push_back(
      "--time: this image depends on how fast the machines were; settings.resolved has the numbers that were chosen");
}

}  // namespace radfarm
