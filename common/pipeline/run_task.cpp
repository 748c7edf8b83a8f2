#include <algorithm>

#include "estimate/gather.h"
#include "estimate/mesh_lines.h"
#include "estimate/paper_gather.h"
#include "estimate/paper_tile.h"
#include "estimate/path_reference.h"
#include "estimate/task_result.h"
#include "frame/tasks.h"
#include "pipeline/prepared.h"
#include "radiosity/element_mesh_file.h"
#include "scene/scene_file.h"

namespace radfarm {
namespace {

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

SampleRadiance gouraud_integrator(const Prepared::Parts& parts, const Film& film) {
  const GouraudContext context{parts.world, *parts.mesh, *parts.sides};
  const SampleRadiance shaded = [context](const Ray& ray, const PixelSampler& sampler, Counters& counters,
                                          FirstSurface* first) {
    return gouraud_radiance(context, ray, sampler, counters, first);
  };
  return parts.view.settings.draws_mesh != 0 ? with_mesh_lines(shaded, context, film) : shaded;
}

GatherContext gather_context(const Prepared::Parts& parts) {
  return {parts.world, parts.tree, *parts.lookup, *parts.senders, parts.view.settings.senders, parts.has_interreflection()};
}

/// Only the gather has a cheaper way to see emission alone; it is asked where pixels may differ in samples.
SampleEmission emission_integrator(const Prepared::Parts& parts) {
  if (!parts.senders || parts.is_paper()) return {};
  return [context = gather_context(parts)](const Ray& ray, const PixelSampler& sampler, Counters& counters) {
    return gather_emission(context, ray, sampler, counters);
  };
}

SampleRadiance integrator(const Prepared::Parts& parts, const Film& film) {
  if (parts.mesh) return gouraud_integrator(parts, film);
  if (!parts.senders) return path_integrator(parts.world, parts.has_interreflection());
  const GatherContext context = gather_context(parts);
  if (parts.is_paper()) {
    return [context](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
      return paper_gather_radiance(context, ray, sampler, counters, first);
    };
  }
  return [context](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface* first) {
    return gather_radiance(context, ray, sampler, counters, first);
  };
}

std::vector<std::byte> run_tile(const Prepared::Parts& parts, std::uint32_t index) {
  const Settings& settings = parts.view.settings;
  TileResult result;
  result.rect = tile_rect(settings, index);
  Film film = film_of(parts.view, settings.effects_off);
  film.cone_samples = settings.camera_samples;
  const SampleRadiance radiance = integrator(parts, film);
  const SampleBudget budget{settings.camera_samples, settings.max_camera_samples, settings.noise};
  if (parts.is_paper()) {
    result.pixels = render_paper_tile(parts.world, film, result.rect, settings.camera_samples, radiance, result.counters);
    return encode(result);
  }
  const Kept kept{settings.aovs != 0, settings.shares_light != 0};
  TilePixels tile = render_tile(film, result.rect, budget, radiance, result.counters, kept,
                                emission_integrator(parts));
  result.pixels = std::move(tile.light);
  result.aovs = std::move(tile.aovs);
  result.sharing = std::move(tile.sharing);
  return encode(result);
}

std::vector<std::byte> run_audit(const Prepared::Parts& parts, std::uint32_t index) {
  const Settings& settings = parts.view.settings;
  // Its rays are lines: the audit is to see what filtering does.
  const Film film = film_of(parts.view, settings.exactly_off);
  const bool has_interreflection = !contains(settings.exactly_off, Effect::kInterreflection);
  const SampleRadiance path = path_integrator(parts.audited(), has_interreflection);
  AuditResult result;
  for (const AuditPixel& chosen : audit_task_pixels(settings, index)) {
    AuditResult::Pixel pixel{chosen.x, chosen.y, {}, {}};
    pixel.first = sample_pixel(film, Stream::kAuditFirst, chosen.x, chosen.y, 0, settings.audit_samples, path,
                               result.counters);
    pixel.second = sample_pixel(film, Stream::kAuditSecond, chosen.x, chosen.y, 0, settings.audit_samples, path,
                                result.counters);
    result.pixels.push_back(pixel);
  }
  return encode(result);
}

}  // namespace

const World& Prepared::Parts::audited() const {
  if (is_exact()) return world;
  std::call_once(is_audited, [&] { audit_world.emplace(specialise(scene, view.settings.exactly_off)); });
  return *audit_world;
}

Prepared::Prepared(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Prepared::Prepared(Prepared&&) noexcept = default;
Prepared& Prepared::operator=(Prepared&&) noexcept = default;
Prepared::~Prepared() = default;

Result<Prepared> Prepared::open(std::span<const std::byte> scene, std::span<const std::byte> solution,
                                std::span<const std::byte> view) {
  RADFARM_TRY(View opened, decode_view(view));
  RADFARM_TRY(Scene decoded, decode_scene(scene));
  const Settings settings = opened.settings;
  const std::vector<std::byte> grid_bytes = std::move(opened.grid);  // not kept once it is decoded
  if (settings.integrator == Settings::Integrator::kPathTrace) {
    return Prepared(std::make_unique<Parts>(std::move(opened), std::move(decoded), SenderTree()));
  }
  if (settings.integrator == Settings::Integrator::kRadiosity) {
    const SideNumbers sides(decoded);
    RADFARM_TRY(ElementMesh mesh, decode_element_mesh(solution, sides.count));
    auto parts = std::make_unique<Parts>(std::move(opened), std::move(decoded), SenderTree());
    parts->mesh = std::move(mesh);
    parts->sides = sides;
    return Prepared(std::move(parts));
  }
  RADFARM_TRY(SenderTree tree, decode_sender_tree(solution));
  auto parts = std::make_unique<Parts>(std::move(opened), std::move(decoded), std::move(tree));
  RADFARM_TRY(SenderGridFile grid, decode_sender_grid(grid_bytes, parts->view.camera, parts->tree,
                                                      parts->world.environment.patches().size()));
  parts->lookup.emplace(parts->world, parts->tree);
  parts->senders.emplace(std::move(grid), parts->world, parts->tree, parts->view.settings.senders, settings.seed);
  return Prepared(std::move(parts));
}

Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view) {
  RADFARM_TRY(const View opened, decode_view(view));
  return cut_tasks(opened.settings);
}

Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task) {
  const std::vector<Task> tasks = cut_tasks(prepared.parts().view.settings);
  if (std::find(tasks.begin(), tasks.end(), task) == tasks.end()) {
    return fail(Code::kInvalidArgument, "the view has no such task");
  }
  if (task.kind == Task::Kind::kAudit) return run_audit(prepared.parts(), task.index);
  return run_tile(prepared.parts(), task.index);
}

}  // namespace radfarm
