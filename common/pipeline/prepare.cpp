#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include <nlohmann/json.hpp>

#include "bake/baked_gltf.h"
#include "base/digest.h"
#include "base/stopwatch.h"
#include "effects/measure.h"
#include "effects/plan.h"
#include "frame/aovs.h"
#include "frame/view.h"
#include "pipeline/expected_cost.h"
#include "pipeline/light_groups.h"
#include "pipeline/pipeline.h"
#include "pipeline/prepare_light.h"
#include "pipeline/resolve.h"
#include "pipeline/stage_clock.h"
#include "scene/light_scene.h"
#include "scene/load_scene.h"
#include "scene/scene_file.h"
#include "scene/summary.h"
#include "radiosity/element_mesh_file.h"
#include "scene/world.h"

namespace radfarm {
namespace {

using nlohmann::json;

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

/// Whether all light is carried by paths, and none by a radiosity solution.
bool follows_paths(const Settings& settings) {
  return settings.integrator == Settings::Integrator::kPathTrace || settings.is_by_photons();
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
  PathPilot pilot;
  json unaudited;
  std::vector<std::byte> scene_bytes;
  json facts;
};

json scene_facts(const Planned& planned) {
  json facts = summarize(planned.world->scene);
  facts["digest"] = sha256_hex(planned.scene_bytes);
  return facts;
}

json warnings(const Planned& planned, const RenderRequest& request) {
  json lines = json::array();
  for (const std::string& note : planned.world->scene.notes) lines.push_back(note);
  if (planned.camera.is_framed) lines.push_back("the file has no camera: framed the bulk of the geometry");
  if ((request.photons || request.radius) && planned.settings.photons == 0) {
    lines.push_back("--photons and --radius are not used: no specular surface sends diffuse ones light worth a photon path; --effects +caustics");
  }
  if (planned.settings.draws_mesh != 0) lines.push_back("--mesh draws over the image: it is not audited");
  if (planned.measurements.has_environment && !planned.plan.is_active("environment")) {
    lines.push_back("the sky is left out: none of " + std::to_string(planned.measurements.pilot.walks) +
                    " walks left the scene; --effects +environment keeps it");
  }
  if (!(planned.measurements.emitted_flux > 0)) lines.push_back("all emitters have zero power: the image is black");
  return lines;
}

/// Settings for a target, by what single paths tell of the view.
Status resolve_by_pilot(const RenderRequest& request, const Effort& effort, Planned& planned) {
  const Camera& camera = planned.camera.camera;
  planned.pilot = trace_pilot(*planned.world, camera, planned.settings);
  if (request.time && !effort.level) {
    const float level = level_in_time(request, *planned.world, camera, planned.pilot, effort.threads);
    planned.settings = resolve_settings(request, camera, {level, effort.by_paths, effort.threads});
    RADFARM_TRY(planned.settings.aovs, requested_aovs(request));
  }
  resolve_paths(request, planned.pilot, effort.threads, planned.settings);
  resolve_audit(request, *planned.world, planned.pilot, planned.settings);
  return {};
}

Result<Planned> plan(const std::filesystem::path& scene_file, const RenderRequest& request, const Progress& progress,
                     StageClock& clock, const Effort& effort = {}) {
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
  // As most scenes are rendered: no other world is needed then.
  planned.world = std::make_unique<World>(specialise(std::move(scene), kFoldable));
  clock.end_stage("acceleration");
  RADFARM_TRY_STATUS(progress.check());
  progress.report("effects");
  RADFARM_TRY(planned.camera, choose_camera(planned.world->scene, request));
  planned.settings = resolve_settings(request, planned.camera.camera, effort);
  RADFARM_TRY(planned.settings.aovs, requested_aovs(request));
  const ViewSize size{planned.camera.camera, planned.settings.width, planned.settings.height};
  planned.measurements = measure(*planned.world, size, request.seed, progress);
  RADFARM_TRY_STATUS(progress.check());
  RADFARM_TRY_STATUS(check_light(*planned.world, planned.measurements));
  RADFARM_TRY_STATUS(resolve_by_pilot(request, effort, planned));
  const bool is_path = follows_paths(planned.settings);
  const Transport gather = request.gather == Gather::kPaper ? Transport::kPaperGather : Transport::kGather;
  RADFARM_TRY(planned.plan, plan_effects(planned.measurements, is_path ? Transport::kPathTrace : gather, request.effects));
  planned.settings.effects_off = planned.plan.off();
  planned.settings.exactly_off = planned.plan.exactly_off();
  resolve_specular_light(request, planned.plan, planned.settings);
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
                   {"warnings", warnings(planned, request)}};
  return planned;
}

json energy_json(const EnergyLedger& energy) {
  return {{"emitted", energy.emitted},
          {"absorbed", energy.absorbed},
          {"escaped", energy.escaped},
          {"truncated", energy.truncated},
          {"closure_error", energy.closure_error}};
}

/// The world without the effects that are off; `made` holds it where it is another.
const World& rendered_world(const Planned& planned, std::optional<World>& made) {
  const bool folds_all = !planned.plan.is_active("caustics") && !planned.plan.is_active("glossy_interreflection");
  if (!changes_scene(planned.settings.effects_off) && folds_all) return *planned.world;
  return made.emplace(specialise(planned.world->scene, planned.settings.effects_off));
}

View view_of(const Planned& planned) { return {planned.camera.camera, planned.settings, "", {}, {}, ""}; }

json group_rows(std::span<const EmitterGroup> groups) {
  json rows = json::array();
  for (const EmitterGroup& group : groups) rows.push_back({{"name", group.name}, {"power_lm", group.flux}});
  return rows;
}

/// One light a group, each by its emitters alone; without groups one by all.
Result<std::vector<PreparedLight>> prepare_lights(const World& world, std::span<const EmitterGroup> groups,
                                                  const PlannedView& planned, StageClock& clock) {
  std::vector<PreparedLight> lights;
  if (groups.empty()) {
    RADFARM_TRY(PreparedLight light, prepare_light(world, planned, clock));
    lights.push_back(std::move(light));
  }
  for (const EmitterGroup& group : groups) {
    View view = planned.view;
    view.light_group = group.name;
    view.settings.seed = seed_of_light_group(view.settings.seed, lights.size());
    const World lit(world, group.shining);
    RADFARM_TRY(PreparedLight light, prepare_light(lit, {planned.request, planned.context, planned.plan, view}, clock));
    lights.push_back(std::move(light));
  }
  return lights;
}

/// What the report says of all light, and of each group's.
void add_facts(std::span<const PreparedLight> lights, std::span<const std::byte> solution, json& facts) {
  PreparedLight all;
  bool is_reused = true;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    add_facts(lights[i], all);
    if (!lights[i].view.light_group.empty()) facts["light_groups"][i].update(lights[i].said);
    is_reused = is_reused && lights[i].said.contains("solution") && lights[i].said["solution"]["reused"].get<bool>();
  }
  facts["counts"] = all.counts;
  if (all.energy) facts["energy"] = energy_json(*all.energy);
  if (lights.size() == 1) facts.update(lights[0].said);
  if (lights.size() > 1 && !solution.empty()) facts["solution"] = {{"digest", sha256_hex(solution)}, {"reused", is_reused}};
}

/// Whether anything is to be known of light before a worker asks.
bool needs_world(const Planned& planned, const RenderRequest& request) {
  return !follows_paths(planned.settings) || wants_light_groups(request);
}

/// What settings are expected to cost. Each light group is an image of its own; the audit is of their sum.
json cost_json(const RenderRequest& request, const Planned& planned, const Settings& settings, std::size_t images) {
  ExpectedCost cost = expect_cost(*planned.world, settings, planned.pilot, noise_share(request, settings));
  const double more = static_cast<double>(images) - 1;
  return {{"cpu_s", {cost.low + more * (cost.low - cost.audit), cost.high + more * (cost.high - cost.audit)}},
          {"audit_cpu_s", cost.audit}};
}

/// Of the request, and of others of the same view.
json expected(const RenderRequest& request, const Planned& planned, std::size_t images) {
  json out = cost_json(request, planned, planned.settings, images);
  out["ray_s"] = planned.pilot.ray_seconds;
  const auto add = [&](const char* name, const RenderRequest& other) {
    Settings settings = resolve_settings(other, planned.camera.camera);
    resolve_specular_light(other, planned.plan, settings);
    resolve_paths(other, planned.pilot, 1, settings);
    resolve_audit(other, *planned.world, planned.pilot, settings);
    json row = cost_json(other, planned, settings, images);
    row["ask"] = name;
    out["others"].push_back(row);
  };
  RenderRequest other = request;
  other.error.reset(), other.time.reset();
  for (const auto& [name, quality] : {std::pair("preview", RenderRequest::Quality::kPreview),
                                      std::pair("standard", RenderRequest::Quality::kStandard),
                                      std::pair("high", RenderRequest::Quality::kHigh)}) {
    other.quality = quality;
    add(name, other);
  }
  other.quality = RenderRequest().quality;
  if (!request.audit || request.mesh) return out;
  other.error = .01;
  add("1 %", other);
  return out;
}

/// Solutions and views, of each light group or of all light, and what is said of them.
Status prepare_views(const RenderRequest& request, const PrepareContext& context, StageClock& clock, Planned& planned,
                     PreparedFiles& files) {
  std::optional<World> made;
  const World& world = needs_world(planned, request) ? rendered_world(planned, made) : *planned.world;
  RADFARM_TRY(const std::vector<EmitterGroup> groups, requested_light_groups(world, request));
  if (wants_light_groups(request)) planned.facts["light_groups"] = group_rows(groups);
  const View view = view_of(planned);
  RADFARM_TRY(std::vector<PreparedLight> lights, prepare_lights(world, groups, {request, context, planned.plan, view}, clock));
  std::vector<std::vector<std::byte>> solutions;
  for (PreparedLight& light : lights) solutions.push_back(std::move(light.solution));
  if (!solutions[0].empty()) files.solution = encode_solutions(solutions);
  add_facts(lights, files.solution, planned.facts);
  planned.facts["expected"] = expected(request, planned, lights.size());
  planned.facts["stages"] = clock.stages();
  planned.facts["peak_memory_bytes"] = peak_memory_bytes();
  std::vector<View> views;
  for (PreparedLight& light : lights) views.push_back(std::move(light.view));
  views[0].facts = planned.facts.dump();
  files.view = encode(views);
  return {};
}

}  // namespace

Result<PreparedFiles> prepare(const std::filesystem::path& scene_file, const RenderRequest& request,
                              const PrepareContext& context, const Effort& effort) {
  StageClock clock;
  RADFARM_TRY(Planned planned, plan(scene_file, request, context.progress, clock, effort));
  PreparedFiles files;
  RADFARM_TRY_STATUS(prepare_views(request, context, clock, planned, files));
  files.scene = std::move(planned.scene_bytes);
  return files;
}

Result<Baked> bake(const std::filesystem::path& scene_file, const RenderRequest& request,
                   const std::optional<float>& exposure_ev, const PrepareContext& context) {
  StageClock clock;
  RADFARM_TRY(Planned planned, plan(scene_file, request, context.progress, clock));
  const World world(specialise(planned.world->scene, planned.settings.effects_off));
  const View view = view_of(planned);
  RADFARM_TRY(const ObtainedLight obtained, obtain_light(world, {request, context, planned.plan, view}, LightForm::kElements));
  RADFARM_TRY(const ElementMesh mesh, decode_element_mesh(obtained.light.file, SideNumbers(world.scene).count));
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
  std::optional<World> made;
  const World& world = wants_light_groups(request) ? rendered_world(planned, made) : *planned.world;
  RADFARM_TRY(const std::vector<EmitterGroup> groups, requested_light_groups(world, request));
  if (wants_light_groups(request)) planned.facts["light_groups"] = group_rows(groups);
  planned.facts["expected"] = expected(request, planned, std::max<std::size_t>(1, groups.size()));
  planned.facts["stages"] = clock.stages();
  return planned.facts;
}

Result<json> describe_scene(const std::filesystem::path& scene_file) {
  RADFARM_TRY(const Scene scene, load_scene(scene_file));
  return summarize(scene);
}

}  // namespace radfarm
