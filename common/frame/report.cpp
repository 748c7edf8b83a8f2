#include "frame/report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "frame/aovs.h"
#include "frame/request.h"

namespace radfarm {
namespace {

using nlohmann::json;

json interval(const std::optional<MeasuredError>& error) {
  if (!error) return nullptr;
  return json::array({error->lower, error->upper});
}

json value(const std::optional<MeasuredError>& error) {
  if (!error || !error->value) return nullptr;
  return *error->value;
}

json accuracy_json(const std::optional<Accuracy>& accuracy, const json& facts) {
  json out = {{"model", "all-materials"}, {"target", nullptr}, {"target_met", nullptr}, {"audited_pixels", 0},
              {"mean", nullptr},         {"rmse", nullptr},   {"rmse_ci95", nullptr},  {"relative_rmse", nullptr},
              {"relative_rmse_ci95", nullptr}};
  out["unaudited"] = facts.value("unaudited", json::array());
  if (!accuracy) return out;
  out["audited_pixels"] = accuracy->audited_pixels;
  out["mean"] = accuracy->mean;
  out["rmse"] = value(accuracy->rmse);
  out["rmse_ci95"] = interval(accuracy->rmse);
  out["relative_rmse"] = value(accuracy->relative_rmse);
  out["relative_rmse_ci95"] = interval(accuracy->relative_rmse);
  out["mse_parts"] = {{"direct", accuracy->direct_mse}, {"indirect", accuracy->indirect_mse},
                      {"specular", accuracy->specular_mse}};
  out["channel_mse"] = accuracy->channel_mse;
  if (accuracy->mse > 0) {
    out["map"] = {{"columns", Accuracy::kMapColumns}, {"rows", Accuracy::kMapRows}, {"share", json::array()}};
    for (const double mse : accuracy->map_mse) out["map"]["share"].push_back(mse / accuracy->mse);
  }
  return out;
}

void add_counts(json& counts, const Settings& settings, const Counters& c) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  counts["camera_rays"] = c.camera_rays;
  counts["visibility_rays"] = c.visibility_rays;
  counts["path_rays"] = c.path_rays;
  counts["form_factor_samples"] = c.form_factor_samples;
  counts["photon_paths"] = c.photon_paths;
  counts["visibility_samples_per_pixel"] = static_cast<double>(c.visibility_rays) / pixels;
  counts["form_factor_samples_per_pixel"] = static_cast<double>(c.form_factor_samples) / pixels;
  counts["grid_vertices_computed_by_workers"] = c.vertices_computed;
}

const char* name_of(Settings::Integrator integrator) {
  switch (integrator) {
    case Settings::Integrator::kGather: return "gather";
    case Settings::Integrator::kPathTrace: return "path-trace";
    case Settings::Integrator::kRadiosity: return "radiosity";
    case Settings::Integrator::kPaths: return "paths";
    case Settings::Integrator::kPhotonMap: return "photon-map";
  }
  return "";
}

}  // namespace

json to_json(const Settings& s) {
  json out = {{"integrator", name_of(s.integrator)},
              {"level", s.level},
              {"width", s.width},
              {"height", s.height},
              {"tile", s.tile},
              {"seed", s.seed},
              {"camera_samples", s.camera_samples},
              {"max_camera_samples", s.max_camera_samples},
              {"noise", s.noise},
              {"sharing", s.shares_light != 0},
              {"audit_pixels", s.audit_pixels},
              {"audit_samples", s.audit_samples},
              {"effects_off", s.effects_off}};
  if (s.target_error > 0) out["target_error"] = s.target_error;
  if (s.aovs != 0) out["aov"] = aov_names(s.aovs);
  if (s.photons > 0) {
    out["photons"] = {{"paths", s.photons}, {"batches", s.photon_batches}, {"radius", s.photon_radius}, {"crossings", s.photon_crossings}};
    return out;
  }
  if (s.integrator == Settings::Integrator::kPathTrace) return out;
  out["radiosity"] = {{"oracle", to_string(s.radiosity.oracle.criterion)},
                      {"max_link_error", s.radiosity.max_link_error},
                      {"min_patch_area", s.radiosity.min_patch_area},
                      {"residual", s.radiosity.residual},
                      {"samples_per_link", s.radiosity.samples_per_link},
                      {"direct_samples", s.radiosity.direct_samples},
                      {"hits_per_patch", s.radiosity.hits_per_patch},
                      {"max_links", s.radiosity.max_links},
                      {"max_passes", s.radiosity.max_passes}};
  if (s.integrator == Settings::Integrator::kRadiosity) {
    out["draws_mesh"] = s.draws_mesh != 0;
    return out;
  }
  out["senders"] = {{"threshold", s.senders.threshold},
                    {"threshold_scale", s.senders.threshold_scale},
                    {"max_elevation", s.senders.max_elevation},
                    {"grid", {s.senders.columns, s.senders.rows, s.senders.slices}},
                    {"max_senders", s.senders.max_senders},
                    {"vertex_samples", s.senders.vertex_samples},
                    {"samples_per_gather", s.senders.samples_per_gather},
                    {"sky_lines", s.senders.sky_lines},
                    {"reflected_rays", s.senders.reflected_rays},
                    {"next_events", s.senders.next_events},
                    {"gather", s.senders.gather == Gather::kPaper ? "paper" : "default"}};
  if (s.senders.gather == Gather::kPaper) out["senders"]["paper_samples"] = s.senders.paper_samples;
  return out;
}

json make_report(json facts, const Settings& settings, const Raster& raster, const Counters& counters,
                 const std::optional<Accuracy>& accuracy, const std::string& image_digest, const FarmFacts& farm) {
  json report = std::move(facts);
  report["version"] = 1;
  report["settings"]["resolved"] = to_json(settings);
  double cpu = 0;
  long long memory = report.value("peak_memory_bytes", 0LL);
  report["workers"] = json::array();
  for (const FarmFacts::Worker& w : farm.workers) {
    report["workers"].push_back(
        {{"name", w.name}, {"tasks", w.tasks}, {"cpu_s", w.cpu_seconds}, {"peak_memory_bytes", w.peak_memory_bytes}});
    cpu += w.cpu_seconds;
    memory = std::max(memory, w.peak_memory_bytes);
  }
  report["stages"].push_back({{"name", "tasks"}, {"wall_s", farm.tasks_wall_seconds}, {"cpu_s", cpu}});
  report["peak_memory_bytes"] = memory;
  add_counts(report["counts"], settings, counters);
  report["accuracy"] = accuracy_json(accuracy, report);
  report.erase("unaudited");
  report["dropped_samples"] = {{"count", counters.dropped_samples}, {"share", dropped_share(raster)}};
  report["image"] = {{"path", ""}, {"digest", image_digest}};
  return report;
}

}  // namespace radfarm
