#include "pipeline/prepare_light.h"

#include <cstdint>

#include "pipeline/resolve.h"
#include "senders/sender_grid.h"

namespace radfarm {
namespace {

using nlohmann::json;

/// Without interreflection nothing is solved that a pilot image could show.
void resolve_thresholds(const EffectsPlan& plan, float mean_radiance, SenderSettings& senders) {
  if (!(senders.threshold_scale > 0)) return;
  senders.threshold = grey_threshold(senders.threshold_scale, mean_radiance);
  if (!plan.is_active("interreflection")) senders.threshold_scale = 0;
  senders.max_elevation = plan.is_active("masking") ? kMaxElevation : 1;
}

/// `masking_bound`: so much more than without masking may all that is interpolated at a point be wrong, mean over visible points.
json perception_json(const VertexThresholds& perception, const SenderSettings& senders) {
  const double elevation = mean_of(perception.elevation);
  return {{"mean_threshold", perception.mean}, {"mean_threshold_without_masking", perception.mean_plain},
          {"exposure_ev", perception.exposure_ev}, {"display_white", kDisplayWhite}, {"max_elevation", senders.max_elevation},
          {"mean_elevation", elevation > 0 ? json(elevation) : json()},
          {"masking_bound", kMaxTail * (perception.mean - perception.mean_plain)}};
}

/// Senders and grid of a view that gathers.
Status prepare_gather(const World& world, const SolvedLight& solved, const PlannedView& planned, PreparedLight& light) {
  RADFARM_TRY(const SenderTree tree, decode_sender_tree(solved.file));
  View& view = light.view;
  Settings& settings = view.settings;
  resolve_thresholds(planned.plan, static_cast<float>(solved.facts.mean_radiance), settings.senders);
  ClassifiedView classified = classify_visible(world, tree, view.camera, settings.width, settings.height, settings.senders,
                                               settings.seed, planned.context.progress);
  RADFARM_TRY_STATUS(planned.context.progress.check());
  // Of a view that sees nothing reflect, the whole scene's.
  const double mean = classified.seen_radiance > 0 ? classified.seen_radiance : solved.facts.mean_radiance;
  settings.noise = noise_share(planned.request, settings) * static_cast<float>(mean);
  const SenderGridFile& grid = classified.file;
  view.grid = encode(grid);
  light.said["perception"] = perception_json(classified.perception, settings.senders);
  if (settings.senders.max_elevation > 1) view.elevation = std::move(classified.perception.elevation);
  light.counts["grid_vertices"] = grid.grid.vertex_count();
  light.counts["grid_vertices_used"] = grid.vertices.size();
  return {};
}

LightForm form_of(const RenderRequest& request) {
  if (request.integrator == RenderRequest::Integrator::kRadiosity) return LightForm::kElements;
  const bool needs_all = request.integrator == RenderRequest::Integrator::kFullGather || request.gather == Gather::kPaper;
  return needs_all ? LightForm::kAllSenders : LightForm::kSenders;
}

}  // namespace

Result<ObtainedLight> obtain_light(const World& world, const PlannedView& planned, LightForm form) {
  const bool is_reflecting = planned.plan.is_active("interreflection");
  return obtain_light(world, {planned.view.settings.radiosity, planned.request.seed, is_reflecting, form},
                      planned.context.solutions, planned.context.progress);
}

Result<PreparedLight> prepare_light(const World& world, const PlannedView& planned, StageClock& clock) {
  PreparedLight light;
  light.view = planned.view;
  const Settings& settings = light.view.settings;
  if (settings.integrator == Settings::Integrator::kPathTrace || settings.is_by_photons()) return light;
  RADFARM_TRY(ObtainedLight obtained, obtain_light(world, planned, form_of(planned.request)));
  const SolvedLight::Facts& facts = obtained.light.facts;
  light.counts = {{"links", facts.links}, {"elements", facts.elements}, {"radiosity_iterations", facts.iterations}};
  if (planned.plan.is_active("interreflection")) light.energy = facts.energy;
  light.said["solution"] = {{"digest", obtained.light.digest}, {"reused", obtained.is_reused}};
  clock.end_stage("radiosity");
  if (light.view.settings.integrator == Settings::Integrator::kGather) {
    RADFARM_TRY_STATUS(prepare_gather(world, obtained.light, planned, light));
    clock.end_stage("senders");
  }
  light.solution = std::move(obtained.light.file);
  return light;
}

void add_facts(const PreparedLight& one, PreparedLight& sum) {
  for (const auto& [name, count] : one.counts.items()) {
    sum.counts[name] = sum.counts.value(name, std::uint64_t{0}) + count.get<std::uint64_t>();
  }
  if (!one.energy) return;
  const EnergyLedger& a = *one.energy;
  EnergyLedger& b = sum.energy ? *sum.energy : sum.energy.emplace();
  const double emitted = a.emitted + b.emitted;
  if (emitted > 0) b.closure_error = (a.closure_error * a.emitted + b.closure_error * b.emitted) / emitted;
  b.emitted = emitted;
  b.absorbed += a.absorbed;
  b.escaped += a.escaped;
  b.truncated += a.truncated;
}

}  // namespace radfarm
