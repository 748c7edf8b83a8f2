#include "pipeline/measure_light.h"

#include <algorithm>
#include <utility>

#include "meters/by_gather.h"
#include "meters/by_paths.h"
#include "meters/isolux.h"
#include "meters/meter_file.h"
#include "scene/light_scene.h"
#include "scene/world.h"

namespace radfarm {
namespace {

bool bends_light(const Material& m) {
  return (m.metallic > 0 || m.transmission > 0 || m.clearcoat > 0) && m.roughness < .1F;
}

/// Paths from meters never meet a point or a direction; they find it by next events, which no mirror or lens passes on.
std::vector<std::string> notes_on(const World& world, MeasureRequest::Method method) {
  const auto& materials = world.scene.materials;
  const bool has_specular = std::any_of(materials.begin(), materials.end(), bends_light);
  if (method == MeasureRequest::Method::kPaths || world.scene.lights.empty() || !has_specular) return {};
  return {"light of points and directions by mirrors and clear glass is not in the readings; --method paths has it"};
}

Result<std::vector<Meter>> place_meters(const World& world, const MeasureRequest& request,
                                        std::optional<WorkPlane>& plane) {
  if (request.points) return read_meters(*request.points, world.scene.origin);
  WorkPlaneSettings settings = request.plane;
  if (settings.floor) *settings.floor -= static_cast<float>(world.scene.origin.y);
  RADFARM_TRY(plane, make_work_plane(world, settings));
  return plane->meters;
}

std::vector<Reading> read_all(const World& world, const std::vector<Meter>& meters, const MeasureRequest& request,
                              const Progress& progress) {
  if (request.method == MeasureRequest::Method::kPaths) {
    PathMeterSettings settings;
    settings.paths = request.photons, settings.radius = request.radius, settings.seed = request.seed;
    return measure_by_paths(world, meters, settings, progress).readings;
  }
  GatherMeterSettings settings;
  settings.error = request.error, settings.samples = request.samples, settings.seed = request.seed;
  return measure_by_gather(world, meters, settings, progress);
}

}  // namespace

Result<MeasuredLight> measure_light(const std::filesystem::path& scene_file, const MeasureRequest& request,
                                    const Progress& progress) {
  progress.report("load");
  RADFARM_TRY(Scene scene, load_scene(scene_file, request.load));
  RADFARM_TRY_STATUS(light_scene({request.env, request.ies}, scene_file.parent_path(), scene));
  RADFARM_TRY_STATUS(progress.check());
  const World world(std::move(scene));
  if (world.emitters.size() == 0 && world.emitters.declared_triangles == 0) {
    return fail(Code::kInvalidArgument,
                "the scene has no emitter: give it an emissive material, a light (KHR_lights_punctual), or --env");
  }
  MeasuredLight measured;
  std::optional<WorkPlane> plane;
  RADFARM_TRY(measured.meters, place_meters(world, request, plane));
  measured.origin = world.scene.origin;
  measured.readings.resize(measured.meters.size());
  if (world.emitters.size() > 0) measured.readings = read_all(world, measured.meters, request, progress);
  RADFARM_TRY_STATUS(progress.check());
  measured.summary = summarise(measured.readings);
  measured.notes = notes_on(world, request.method);
  if (!plane) return measured;
  measured.floor = plane->floor + static_cast<float>(measured.origin.y);
  measured.levels = contour_levels(measured.summary.least, measured.summary.most);
  if (!request.picture) return measured;
  RADFARM_TRY(measured.png, isolux_png(*plane, measured.readings, measured.levels));
  return measured;
}

}  // namespace radfarm
