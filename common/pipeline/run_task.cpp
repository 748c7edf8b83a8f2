#include <algorithm>

#include <nlohmann/json.hpp>

#include "estimate/gather.h"
#include "estimate/mesh_lines.h"
#include "estimate/paper_gather.h"
#include "estimate/paper_tile.h"
#include "estimate/path_reference.h"
#include "estimate/task_result.h"
#include "frame/tasks.h"
#include "pipeline/light_groups.h"
#include "pipeline/prepared.h"
#include "radiosity/element_mesh_file.h"
#include "scene/scene_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMostDiscSamples = 16;  // camera rays a pixel that choose its discs

Film film_of(const View& view, EffectSet off) {
  Film film{view.camera, view.settings.width, view.settings.height, view.settings.seed};
  if (contains(off, Effect::kDepthOfField)) film.camera.lens_diameter = 0;
  return film;
}

SampleRadiance path_integrator(const World& world, bool has_interreflection) {
  return [&world, has_interreflection](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
    return trace_path(world, ray, sampler, counters, has_interreflection, first);
  };
}

SampleRadiance gouraud_integrator(const LitView& lit, const Film& film) {
  const GouraudContext context{lit.world, *lit.mesh, *lit.sides};
  const SampleRadiance shaded = [context](const Ray& ray, const PixelSampler& sampler, Counters& counters,
                                          FirstSurface* first) {
    return gouraud_radiance(context, ray, sampler, counters, first);
  };
  return lit.view.settings.draws_mesh != 0 ? with_mesh_lines(shaded, context, film) : shaded;
}

GatherContext gather_context(const LitView& lit) {
  return {lit.world, lit.tree, *lit.lookup, *lit.senders, lit.view.settings.senders, lit.has_interreflection()};
}

/// Only the gather has a cheaper way to see emission alone; it is asked where pixels may differ in samples.
SampleEmission emission_integrator(const LitView& lit) {
  if (!lit.senders || lit.is_paper()) return {};
  return [context = gather_context(lit)](const Ray& ray, const PixelSampler& sampler, Counters& counters) {
    return gather_emission(context, ray, sampler, counters);
  };
}

SampleRadiance integrator(const LitView& lit, const Film& film) {
  if (lit.mesh) return gouraud_integrator(lit, film);
  if (lit.view.settings.is_by_photons()) {
    return [&lit](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
      return unlit_radiance(lit.world, ray, sampler, counters, first);
    };
  }
  if (!lit.senders) return path_integrator(lit.world, lit.has_interreflection());
  const GatherContext context = gather_context(lit);
  if (lit.is_paper()) {
    return [context](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
      return paper_gather_radiance(context, ray, sampler, counters, first);
    };
  }
  return [context](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
    return gather_radiance(context, ray, sampler, counters, first);
  };
}

TilePixels pixels_of(TileResult result) {
  return {std::move(result.pixels), std::move(result.aovs), std::move(result.sharing), std::move(result.needs)};
}

/// What a tile starts from.
Result<TileResult> tile_before(const Settings& settings, std::uint32_t index, std::span<const std::byte> before) {
  RADFARM_TRY(TileResult result, decode_tile_result(before));
  const bool is_whole = result.rect == tile_rect(settings, index) && (settings.aovs != 0) == !result.aovs.empty() &&
                        (settings.shares_light != 0) == !result.sharing.empty();
  if (!is_whole) return fail(Code::kDataLoss, "tile " + std::to_string(index) + " cannot go on from another tile's sums");
  return result;
}

Result<std::vector<std::byte>> run_tile(const LitView& lit, std::uint32_t index, const TaskRound& of) {
  const Settings& settings = lit.view.settings;
  TileResult result;
  result.rect = tile_rect(settings, index);
  Film film = film_of(lit.view, settings.effects_off);
  film.cone_samples = settings.camera_samples;
  const SampleRadiance radiance = integrator(lit, film);
  const SampleBudget budget = budget_of(settings, of.round);
  if (lit.is_paper()) {
    // Of its own kind of sums; these cannot go on.
    const std::uint32_t samples = samples_of(budget, {});
    result.pixels = render_paper_tile(lit.world, film, result.rect, samples, radiance, result.counters);
    return encode(result);
  }
  const Kept kept{settings.aovs != 0, settings.shares_light != 0};
  TilePixels tile;
  if (of.before.empty()) {
    tile = render_tile(film, result.rect, budget, radiance, result.counters, kept, emission_integrator(lit));
  } else {
    RADFARM_TRY(TileResult before, tile_before(settings, index, of.before));
    if (is_even(budget) != before.needs.empty()) return fail(Code::kDataLoss, "a tile cannot go on by another budget");
    result.counters = before.counters;
    tile = resume_tile(film, result.rect, budget, radiance, result.counters, kept, emission_integrator(lit),
                       pixels_of(std::move(before)));
  }
  result.pixels = std::move(tile.light);
  result.aovs = std::move(tile.aovs);
  result.sharing = std::move(tile.sharing);
  result.needs = std::move(tile.needs);
  return encode(result);
}

SeenDiscSettings seen_disc_settings(const Settings& settings) {
  SeenDiscSettings discs{std::min(settings.camera_samples, kMostDiscSamples), settings.photons, settings.photon_radius,
                         settings.photon_crossings, settings.photon_origins};
  discs.is_map = settings.integrator == Settings::Integrator::kPhotonMap;
  return discs;
}

Result<std::vector<std::byte>> run_photons(const LitView& lit, std::uint32_t task, const TaskRound& of) {
  const Settings& settings = lit.view.settings;
  const LitView::Photons& photons = lit.photons(film_of(lit.view, settings.effects_off));
  const std::size_t pixels = static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  const std::uint64_t paths = paths_of_batch(settings, task);
  PhotonResult sum{0, std::vector<PhotonPixel>(pixels)};
  if (!of.before.empty()) {
    RADFARM_TRY(sum, decode_photon_result(of.before));
    if (sum.pixels.size() != pixels || sum.paths % paths != 0) {
      return fail(Code::kDataLoss, "photons cannot go on from another image's");
    }
  }
  for (std::uint64_t pass = sum.paths / paths; pass < photon_passes(of.round); ++pass) {
    const PathBatch batch{settings.seed, task + pass * settings.photon_batches, paths};
    add(photons.set ? bring_light(lit.world, *photons.set, photons.seen.shown, pixels, settings.photon_origins, batch)
                    : bring_photons(lit.world, photons.seen, pixels, settings.photon_origins, batch),
        sum);
  }
  return encode(sum);
}

std::vector<std::byte> run_audit(const Prepared::Parts& parts, const Round& round, std::uint32_t index) {
  const Settings& settings = parts.settings;
  // Its rays are lines: the audit is to see what filtering does.
  Film film = film_of(parts.lit[0]->view, settings.exactly_off);
  film.seed = audit_seed(settings, round);
  const bool has_interreflection = !contains(settings.exactly_off, Effect::kInterreflection);
  const SampleRadiance path = path_integrator(parts.audited(), has_interreflection);
  AuditResult result;
  for (const AuditPixel& chosen : audit_task_pixels(settings, round, index)) {
    AuditResult::Pixel pixel{chosen.x, chosen.y, {}, {}};
    pixel.first = sample_pixel(film, Stream::kAuditFirst, chosen.x, chosen.y, 0, round.audit_samples, path, result.counters);
    pixel.second = sample_pixel(film, Stream::kAuditSecond, chosen.x, chosen.y, 0, round.audit_samples, path, result.counters);
    result.pixels.push_back(pixel);
  }
  return encode(result);
}

/// With what its integrator needs.
Result<std::unique_ptr<LitView>> open_lit(View view, const World& world, std::optional<Shining> some,
                                          std::span<const std::byte> solution) {
  const Settings settings = view.settings;
  const std::vector<std::byte> grid_bytes = std::move(view.grid);  // not kept once it is decoded
  SenderTree tree;
  if (settings.integrator == Settings::Integrator::kGather) {
    RADFARM_TRY(tree, decode_sender_tree(solution));
  }
  auto lit = std::make_unique<LitView>(std::move(view), world, std::move(some), std::move(tree));
  if (settings.integrator == Settings::Integrator::kRadiosity) {
    lit->sides.emplace(world.scene);
    RADFARM_TRY(lit->mesh, decode_element_mesh(solution, lit->sides->count));
  }
  if (settings.integrator != Settings::Integrator::kGather) return lit;
  RADFARM_TRY(SenderGridFile grid, decode_sender_grid(grid_bytes, lit->view.camera, lit->tree,
                                                      lit->world.environment.patches().size()));
  lit->lookup.emplace(lit->world, lit->tree);
  lit->senders.emplace(std::move(grid), lit->world, lit->tree, lit->view.settings.senders, settings.seed);
  return lit;
}

}  // namespace

const World& Prepared::Parts::audited() const {
  if (is_exact()) return world;
  std::call_once(is_audited, [&] { audit_world.emplace(specialise(scene, settings.exactly_off)); });
  return *audit_world;
}

LitView::Photons::Photons(const LitView& lit, const Film& film)
    : components(lit.world.scene), seen(see_discs(lit.world, components, film, seen_disc_settings(lit.view.settings))) {
  if (lit.view.settings.integrator != Settings::Integrator::kPhotonMap) set.emplace(lit.world, components, seen.discs);
}

const LitView::Photons& LitView::photons(const Film& film) const {
  std::call_once(has_photons, [&] { seen_photons.emplace(*this, film); });
  return *seen_photons;
}

Prepared::Prepared(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Prepared::Prepared(Prepared&&) noexcept = default;
Prepared& Prepared::operator=(Prepared&&) noexcept = default;
Prepared::~Prepared() = default;

Result<Prepared> Prepared::open(std::span<const std::byte> scene, std::span<const std::byte> solution,
                                std::span<const std::byte> view) {
  RADFARM_TRY(std::vector<View> views, decode_views(view));
  RADFARM_TRY(Scene decoded, decode_scene(scene));
  auto parts = std::make_unique<Parts>(views[0].settings, std::move(decoded));
  std::vector<std::span<const std::byte>> solutions(views.size());
  if (parts->settings.integrator != Settings::Integrator::kPathTrace && !parts->settings.is_by_photons()) {
    RADFARM_TRY(solutions, decode_solutions(solution, views.size()));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::optional<Shining> some;
    if (!views[i].light_group.empty()) {
      RADFARM_TRY(some, shining_of(parts->world, i, views[i].light_group));
    }
    RADFARM_TRY(std::unique_ptr<LitView> lit, open_lit(std::move(views[i]), parts->world, std::move(some), solutions[i]));
    parts->lit.push_back(std::move(lit));
  }
  return Prepared(std::move(parts));
}

Result<Round> first_round(std::span<const std::byte> view) {
  RADFARM_TRY(const std::vector<View> views, decode_views(view));
  return first_round(views[0].settings);
}

Result<nlohmann::json> expected_cost_of(std::span<const std::byte> view) {
  RADFARM_TRY(const std::vector<View> views, decode_views(view));
  const nlohmann::json facts = nlohmann::json::parse(views[0].facts, nullptr, /*allow_exceptions=*/false);
  if (!facts.is_object() || !facts.contains("expected")) return fail(Code::kDataLoss, "view: its facts say no cost");
  return facts["expected"];
}

Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view, const Round& round) {
  RADFARM_TRY_STATUS(check(round));
  RADFARM_TRY(const std::vector<View> views, decode_views(view));
  return cut_tasks(views[0].settings, round, views.size());
}

Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view) {
  RADFARM_TRY(const Round round, first_round(view));
  return cut_tasks(view, round);
}

Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task, const TaskRound& of) {
  RADFARM_TRY_STATUS(check(of.round));
  const Prepared::Parts& parts = prepared.parts();
  const std::vector<Task> tasks = cut_tasks(parts.settings, of.round, parts.lit.size());
  if (std::find(tasks.begin(), tasks.end(), task) == tasks.end()) {
    return fail(Code::kInvalidArgument, "the view has no such task");
  }
  if (task.kind == Task::Kind::kAudit) return run_audit(parts, of.round, task.index);
  if (task.kind == Task::Kind::kPhotons) {
    const std::uint32_t batches = parts.settings.photon_batches;
    return run_photons(*parts.lit[task.index / batches], task.index % batches, of);
  }
  const auto tiles = static_cast<std::uint32_t>(tile_count(parts.settings));
  return run_tile(*parts.lit[task.index / tiles], task.index % tiles, of);
}

Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task) {
  return run_task(prepared, task, {first_round(prepared.parts().settings), {}});
}

}  // namespace radfarm
