#include "effects/measure.h"

#include <algorithm>
#include <set>
#include <vector>

#include "base/random.h"
#include "math/sampling.h"
#include "scene/emission_sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kProbes = 1024;
constexpr int kBounces = 8;
constexpr std::uint64_t kProbeKey = 0x70726f6265;  // "probe"

void count_materials(const Scene& scene, Measurements& m) {
  std::set<std::uint32_t> used;
  for (const Instance& instance : scene.instances) used.insert(scene.meshes[instance.mesh].material);
  for (const std::uint32_t id : used) {
    const Material& material = scene.materials[id];
    const bool is_textured = material.reflectance_texture != kNone;
    m.max_reflectance = std::max(m.max_reflectance, max_component(material.reflectance));
    m.min_reflectance = std::min(m.min_reflectance, is_textured ? 0 : min_component(material.reflectance));
    m.max_radiance = std::max(m.max_radiance, luminance(material.emission));
    m.glossy_materials += material.folds_gloss_into_diffuse ? 1 : 0;
    m.reflectance_textures += is_textured ? 1 : 0;
    m.emission_textures += material.emission_texture != kNone && !is_black(material.emission) ? 1 : 0;
  }
}

/// Follows light from an emitter over a few diffuse bounces: true when it meets nothing on the way.
bool walk_escapes(const World& world, RandomSequence& random) {
  const double choice = random.uniform_double();
  const Vec2 place{random.uniform(), random.uniform()}, direction{random.uniform(), random.uniform()};
  Ray ray = sample_emission(world, choice, place, direction).ray;
  for (int bounce = 0; bounce < kBounces; ++bounce) {
    const auto hit = world.caster.closest(ray, random.bits());
    if (!hit) return true;
    SurfacePoint point = world.surfaces.at(*hit);
    face(point, -ray.direction);
    const Vec3 local = sample_cosine_hemisphere({random.uniform(), random.uniform()});
    ray = {leave(point), normalize(Frame(point.geometric_normal).to_world(local))};
  }
  return false;
}

void probe_openness(const World& world, std::uint64_t seed, Measurements& m) {
  if (world.emitters.size() == 0) return;
  for (m.probes = 0; m.probes < kProbes; ++m.probes) {
    RandomSequence random(combine(seed, kProbeKey, m.probes));
    if (walk_escapes(world, random)) ++m.escaped;
  }
}

}  // namespace

Measurements measure(const World& world, std::uint64_t seed) {
  Measurements m;
  m.emissive_triangles = world.emitters.declared_triangles;
  m.punctual_lights = world.scene.lights.size();
  m.emitted_flux = world.emitters.total_flux;
  count_materials(world.scene, m);
  for (std::uint32_t mesh = 0; mesh < world.scene.meshes.size(); ++mesh) {
    m.cutout_meshes += world.surfaces.has_holes(mesh) ? 1 : 0;
  }
  probe_openness(world, seed, m);
  return m;
}

}  // namespace radfarm
