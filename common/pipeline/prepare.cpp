#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>

#include "bake/baked_gltf.h"
#include "base/digest.h"
#include "base/stopwatch.h"
#include "effects/measure.h"
#include "effects/plan.h"
#include "frame/aovs.h"
#include "frame/view.h"
#include "pipeline/expected_cost.h"
#include "pipeline/pipeline.h"
#include "pipeline/resolve.h"
#include "pipeline/solve_light.h"
#include "scene/light_scene.h"
#include "scene/load_scene.h"
#include "scene/scene_file.h"
#include "scene/summary.h"
#include "radiosity/element_mesh_file.h"
#include "scene/world.h"
#include "senders/sender_grid.h"

namespace radfarm {
namespace {

using nlohmann::json;

/// Times the stages of prepare() for the report.
class StageClock {
 public:
  void end_stage(const char* name) {
    stages_.push_back({{"name", name}, {"wall_s", watch_.wall_seconds()}, {"cpu_s", watch_.cpu_seconds()}});
    watch_ = Stopwatch();
  }
  json stages() const { return stages_; }

 private:
  Stopwatch watch_;
  json stages_ = json::array();
};

LoadOptions load_options(const RenderRequest& request) {
  LoadOptions options;
  options.up = request.up == RenderRequest::UpAxis::kZ ? LoadOptions::UpAxis::kZ : LoadOptions::UpAxis::kY;
  return options;
}

/// The light source as a person knows it: by its material, or by its own name.
std::string name_of_emitter(const World& world, std::size_t emitter) {
  const std::vector<EmissiveTriangle>& triangles = world.emitters.triangles;
  if (emitter >= triangles.size()) return "light \"" + world.emitters.punctual[emitter - triangles.size()].name + "\"";
  const std::uint32_t mesh = world.scene.instances[triangles[emitter].instance].mesh;
  return "material \"" + world.scene.materials[world.scene.meshes[mesh].material].name + "\"";
}

Status refuse_trapped(const World& world, const TrappedLight& trapped) {
  const std::string channel = std::array{"red", "green", "blue"}[trapped.channel];
  return fail(Code::kInvalidArgument,
              "no light can be lost: the " + channel + " light of " + name_of_emitter(world, trapped.emitter) +
                  " stays where every surface reflects all of it (none lost in " + std::to_string(trapped.reflections) +
                  " reflections); lower a reflectance there below 1 or open it");
}

/// A scene without light, or with light that can never be lost, has no image.
Status check_light(const World& world, const Measurements& m) {
  const bool is_declared = m.emissive_triangles > 0 || m.punctual_lights > 0 || m.has_environment;
  if (!is_declared && world.scene.instances.empty()) {
    return fail(Code::kInvalidArgument, "the scene has no triangles: points and lines are not rendered");
  }
  if (!is_declared) {
    return fail(Code::kInvalidArgument,
                "the scene has no emitter: give it an emissive material, a light (KHR_lights_punctual), or --env");
  }
  if (m.trapped) return refuse_trapped(world, *m.trapped);
  return {};
}

json bound_json(double bound) { return std::isfinite(bound) ? json(bound) : json("unbounded"); }

/// What neither the image nor the path tracer, which audits it, can carry.
json unaudited(const Measurements& m) {
  json list = json::array();
  if (m.punctual_lights > 0 && m.mirrors + m.mirror_coats + m.volumes > 0) {
    list.push_back("light of points and directions by mirrors and clear glass: no path meets it");
  }
  return list;
}

json effects_json(const EffectsPlan& plan) {
  json rows = json::array();
  for (const EffectDecision& e : plan.effects) {
    rows.push_back({{"id", e.id}, {"active", e.active}, {"test", e.test}, {"value", bound_json(e.value)},
                    {"bound", bound_json(e.bound)},
                    {"bound_kind", e.bound_kind}, {"bound_scope", e.bound_scope}, {"note", e.note}});
  }
  return rows;
}

/// Everything before the integrators: loaded, made ready, measured and planned.
struct Planned {
  std::unique_ptr<World> world;
  Measurements measurements;
  EffectsPlan plan;
  ChosenCamera camera;
  Settings settings;
  json unaudited;
  std::vector<std::byte> scene_bytes;
  json facts;
};

json scene_facts(const Planned& planned) {
  json facts = summarize(planned.world->scene);
  facts["digest"] = sha256_hex(planned.scene_bytes);
  return facts;
}

json warnings(const Planned& planned) {
  json lines = json::array();
  for (const std::string& note : planned.world->scene.notes) lines.push_back(note);
  if (planned.camera.is_framed) lines.push_back("the file has no camera: framed the bulk of the geometry");
  if (planned.settings.draws_mesh != 0) lines.push_back("--mesh draws over the image: it is not audited");
  if (planned.measurements.has_environment && !planned.plan.is_active("environment")) {
    lines.push_back("the sky is left out: none of " + std::to_string(planned.measurements.pilot.walks) +
                    " walks left the scene; --effects +environment keeps it");
  }
  if (!(planned.measurements.emitted_flux > 0)) lines.push_back("all emitters have zero power: the image is black");
  return lines;
}

Result<Planned> plan(const std::filesystem::path& scene_file, const RenderRequest& request, const Progress& progress,
                     StageClock& clock) {
  RADFARM_TRY_STATUS(validate(request));
  Planned planned;
  progress.report("load");
  RADFARM_TRY(Scene scene, load_scene(scene_file, load_options(request)));
  RADFARM_TRY_STATUS(progress.check());
  progress.report("load: light");
  RADFARM_TRY_STATUS(light_scene({request.env, request.ies}, scene_file.parent_path(), scene));
  planned.scene_bytes = encode_scene(scene);
  clock.end_stage("load");
  RADFARM_TRY_STATUS(progress.check());
  progress.report("acceleration");
  planned.world = std::make_unique<World>(std::move(scene));
  clock.end_stage("acceleration");
  RADFARM_TRY_STATUS(progress.check());
  progress.report("effects");
  RADFARM_TRY(planned.camera, choose_camera(planned.world->scene, request));
  planned.settings = resolve_settings(request, planned.camera.camera);
  RADFARM_TRY(planned.settings.aovs, requested_aovs(request));
  const ViewSize size{planned.camera.camera, planned.settings.width, planned.settings.height};
  planned.measurements = measure(*planned.world, size, request.seed, progress);
  RADFARM_TRY_STATUS(progress.check());
  RADFARM_TRY_STATUS(check_light(*planned.world, planned.measurements));
  const bool is_path = planned.settings.integrator == Settings::Integrator::kPathTrace;
  const Transport gather = request.gather == Gather::kPaper ? Transport::kPaperGather : Transport::kGather;
  RADFARM_TRY(planned.plan, plan_effects(planned.measurements, is_path ? Transport::kPathTrace : gather, request.effects));
  planned.settings.effects_off = planned.plan.off();
  planned.settings.exactly_off = planned.plan.exactly_off();
  planned.unaudited = unaudited(planned.measurements);
  clock.end_stage("effects");
  planned.facts = {{"scene", scene_facts(planned)},
                   {"settings", {{"requested", to_json(request)}}},
                   {"effects", effects_json(planned.plan)},
                   {"effects_bound", {{"mean", bound_json(planned.plan.total_mean_bound())},
                                      {"max", bound_json(planned.plan.total_max_bound())}}},
                   {"unaudited", planned.unaudited},
                   {"counts", json::object()},
                   {"energy", {{"emitted", planned.measurements.emitted_flux}, {"absorbed", nullptr},
                               {"escaped", nullptr}, {"truncated", nullptr}, {"closure_error", nullptr}}},
                   {"warnings", warnings(planned)}};
  return planned;
}

json energy_json(const EnergyLedger& energy) {
  return {{"emitted", energy.emitted},
          {"absorbed", energy.absorbed},
          {"escaped", energy.escaped},
          {"truncated", energy.truncated},
          {"closure_error", energy.closure_error}};
}

/// The light of a world as planned, and what the report says of it.
Result<SolvedLight> obtain_light(const World& world, const RenderRequest& request, const PrepareContext& context,
                                 LightForm form, Planned& planned) {
  const bool is_reflecting = planned.plan.is_active("interreflection");
  RADFARM_TRY(ObtainedLight obtained, obtain_light(world, {planned.settings.radiosity, request.seed, is_reflecting, form},
                                                   context.solutions, context.progress));
  const SolvedLight::Facts& facts = obtained.light.facts;
  planned.facts["counts"]["links"] = facts.links;
  planned.facts["counts"]["elements"] = facts.elements;
  planned.facts["counts"]["radiosity_iterations"] = facts.iterations;
  if (is_reflecting) planned.facts["energy"] = energy_json(facts.energy);
  planned.facts["solution"] = {{"digest", obtained.light.digest}, {"reused", obtained.is_reused}};
  return std::move(obtained.light);
}

/// Without interreflection nothing is solved that a pilot image could show.
void resolve_thresholds(const Planned& planned, float mean_radiance, SenderSettings& senders) {
  if (!(senders.threshold_scale > 0)) return;
  senders.threshold = grey_threshold(senders.threshold_scale, mean_radiance);
  if (!planned.plan.is_active("interreflection")) senders.threshold_scale = 0;
  senders.max_elevation = planned.plan.is_active("masking") ? kMaxElevation : 1;
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
Status prepare_gather(const World& world, const SolvedLight& light, const RenderRequest& request, const PrepareContext& context,
                      StageClock& clock, Planned& planned, View& view) {
  RADFARM_TRY(const SenderTree tree, decode_sender_tree(light.file));
  Settings& settings = view.settings;
  resolve_thresholds(planned, static_cast<float>(light.facts.mean_radiance), settings.senders);
  ClassifiedView classified = classify_visible(world, tree, view.camera, settings.width, settings.height, settings.senders,
                                               settings.seed, context.progress);
  RADFARM_TRY_STATUS(context.progress.check());
  // Of a view that sees nothing reflect, the whole scene's.
  const double mean = classified.seen_radiance > 0 ? classified.seen_radiance : light.facts.mean_radiance;
  settings.noise = noise_share(request) * static_cast<float>(mean);
  const SenderGridFile& grid = classified.file;
  view.grid = encode(grid);
  planned.facts["perception"] = perception_json(classified.perception, settings.senders);
  if (settings.senders.max_elevation > 1) view.elevation = std::move(classified.perception.elevation);
  planned.facts["counts"]["grid_vertices"] = grid.grid.vertex_count();
  planned.facts["counts"]["grid_vertices_used"] = grid.vertices.size();
  clock.end_stage("senders");
  return {};
}

/// Radiosity in the scene without the effects that are off, and what the integrator makes of it.
Status prepare_light(const RenderRequest& request, const PrepareContext& context, StageClock& clock, Planned& planned,
                     View& view, PreparedFiles& files) {
  std::optional<World> specialised;
  const EffectSet off = planned.settings.effects_off;
  if (changes_scene(off)) specialised.emplace(specialise(planned.world->scene, off));
  const World& world = specialised ? *specialised : *planned.world;
  const bool is_shown = view.settings.integrator == Settings::Integrator::kRadiosity;
  const bool needs_all = request.integrator == RenderRequest::Integrator::kFullGather || request.gather == Gather::kPaper;
  const LightForm form = is_shown ? LightForm::kElements : (needs_all ? LightForm::kAllSenders : LightForm::kSenders);
  RADFARM_TRY(SolvedLight light, obtain_light(world, request, context, form, planned));
  clock.end_stage("radiosity");
  if (!is_shown) RADFARM_TRY_STATUS(prepare_gather(world, light, request, context, clock, planned, view));
  files.solution = std::move(light.file);
  return {};
}

}  // namespace

Result<PreparedFiles> prepare(const std::filesystem::path& scene_file, const RenderRequest& request,
                              const PrepareContext& context) {
  StageClock clock;
  RADFARM_TRY(Planned planned, plan(scene_file, request, context.progress, clock));
  PreparedFiles files;
  View view{planned.camera.camera, planned.settings, "", {}, {}};
  if (view.settings.integrator != Settings::Integrator::kPathTrace) {
    RADFARM_TRY_STATUS(prepare_light(request, context, clock, planned, view, files));
  }
  planned.facts["stages"] = clock.stages();
  planned.facts["peak_memory_bytes"] = peak_memory_bytes();
  view.facts = planned.facts.dump();
  files.view = encode(view);
  files.scene = std::move(planned.scene_bytes);
  return files;
}

Result<Baked> bake(const std::filesystem::path& scene_file, const RenderRequest& request,
                   const std::optional<float>& exposure_ev, const PrepareContext& context) {
  StageClock clock;
  RADFARM_TRY(Planned planned, plan(scene_file, request, context.progress, clock));
  const World world(specialise(planned.world->scene, planned.settings.effects_off));
  RADFARM_TRY(const SolvedLight light, obtain_light(world, request, context, LightForm::kElements, planned));
  RADFARM_TRY(const ElementMesh mesh, decode_element_mesh(light.file, SideNumbers(world.scene).count));
  context.progress.report("glTF");
  Baked baked;
  baked.exposure_ev = exposure_ev ? *exposure_ev : auto_exposure(world, mesh);
  const BakedScene scene = bake_mesh(world, mesh, baked.exposure_ev);
  for (const BakedMesh& one : scene.meshes) baked.triangles += one.triangles.size();
  for (const Element& element : mesh.elements) baked.elements += element.is_undivided() ? 1 : 0;
  const json extras = {{"scene_digest", planned.facts["scene"]["digest"]}, {"requested", to_json(request)}};
  RADFARM_TRY(baked.glb, encode_baked_glb(scene, world, extras));
  return baked;
}

Result<json> explain(const std::filesystem::path& scene_file, const RenderRequest& request) {
  StageClock clock;
  RADFARM_TRY(Planned planned, plan(scene_file, request, Progress(), clock));
  planned.facts["settings"]["resolved"] = to_json(planned.settings);
  const ExpectedCost cost = expect_cost(*planned.world, planned.camera.camera, planned.settings);
  planned.facts["expected"] = {{"cpu_s", {cost.low, cost.high}}, {"audit_cpu_s", cost.audit}, {"ray_s", cost.ray_seconds}};
  planned.facts["stages"] = clock.stages();
  return planned.facts;
}

Result<json> describe_scene(const std::filesystem::path& scene_file) {
  RADFARM_TRY(const Scene scene, load_scene(scene_file));
  return summarize(scene);
}

}  // namespace radfarm
