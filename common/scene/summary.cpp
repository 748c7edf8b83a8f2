#include "scene/summary.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace radfarm {
namespace {

using nlohmann::json;

json triple(const Vec3d& v) { return json::array({v.x, v.y, v.z}); }

/// Triangles, area and bounds of everything that is placed in the world.
struct Placed {
  std::size_t triangles = 0;
  double area = 0;
  double emissive_area = 0;
  Imath::Box3d bounds;
};

Placed measure(const Scene& scene) {
  Placed placed;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const Matrix4d to_world(instance.to_world);
    double area = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3d a = to_double(mesh.positions[t[0]]) * to_world;
      const Vec3d b = to_double(mesh.positions[t[1]]) * to_world;
      const Vec3d c = to_double(mesh.positions[t[2]]) * to_world;
      area += length(cross(b - a, c - a)) / 2;
      for (const Vec3d& p : {a, b, c}) placed.bounds.extendBy(p + scene.origin);
    }
    placed.triangles += mesh.triangles.size();
    placed.area += area;
    if (!is_black(scene.materials[mesh.material].emission)) placed.emissive_area += area;
  }
  return placed;
}

json cameras_of(const Scene& scene) {
  json cameras = json::array();
  for (const Camera& camera : scene.cameras) {
    const bool is_perspective = camera.kind == Camera::Kind::kPerspective;
    cameras.push_back({{"name", camera.name},
                       {"kind", is_perspective ? "perspective" : "orthographic"},
                       {"position", triple(to_double(camera.position) + scene.origin)},
                       {"forward", triple(to_double(camera.forward))}});
  }
  return cameras;
}

json lights_of(const Scene& scene) {
  const auto count = [&](PunctualLight::Kind kind) {
    return std::count_if(scene.lights.begin(), scene.lights.end(), [&](const auto& l) { return l.kind == kind; });
  };
  return {{"point", count(PunctualLight::Kind::kPoint)},
          {"spot", count(PunctualLight::Kind::kSpot)},
          {"directional", count(PunctualLight::Kind::kDirectional)}};
}

}  // namespace

json summarize(const Scene& scene) {
  const Placed placed = measure(scene);
  std::size_t stored = 0;
  for (const Mesh& mesh : scene.meshes) stored += mesh.triangles.size();
  std::size_t texels = 0;
  for (const Texture& texture : scene.textures) texels += texture.texels.size();
  json bounds = nullptr;
  if (!placed.bounds.isEmpty()) bounds = {{"min", triple(placed.bounds.min)}, {"max", triple(placed.bounds.max)}};
  const auto emissive = std::count_if(scene.materials.begin(), scene.materials.end(),
                                      [](const Material& material) { return !is_black(material.emission); });
  return {{"triangles", placed.triangles},
          {"stored_triangles", stored},
          {"meshes", scene.meshes.size()},
          {"instances", scene.instances.size()},
          {"materials", scene.materials.size()},
          {"emissive_materials", emissive},
          {"textures", scene.textures.size()},
          {"texture_megapixels", static_cast<double>(texels) / 1e6},
          {"lights", lights_of(scene)},
          {"cameras", cameras_of(scene)},
          {"bounds", bounds},
          {"surface_area_m2", placed.area},
          {"emissive_area_m2", placed.emissive_area},
          {"origin", triple(scene.origin)},
          {"notes", scene.notes}};
}

}  // namespace radfarm
