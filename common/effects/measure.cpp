#include "effects/measure.h"

#include <algorithm>
#include <set>
#include <vector>

#include "base/random.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kProbes = 4096;
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

void probe_openness(const World& world, std::uint64_t seed, Measurements& m) {
  std::vector<double> areas;
  std::vector<Hit> triangles;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const std::size_t count = world.scene.meshes[world.scene.instances[i].mesh].triangles.size();
    for (std::uint32_t t = 0; t < count; ++t) {
      const TriangleVertices v = world.surfaces.triangle(i, t);
      areas.push_back(length(cross(to_double(v[1]) - to_double(v[0]), to_double(v[2]) - to_double(v[0]))));
      triangles.push_back({i, t, 0, 0, 0});
    }
  }
  if (triangles.empty()) return;
  const DiscreteDistribution by_area(areas);
  for (m.probes = 0; m.probes < kProbes; ++m.probes) {
    RandomSequence random(combine(seed, kProbeKey, m.probes));
    Hit hit = triangles[by_area.sample(random.uniform()).index];
    const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
    hit.u = b.y, hit.v = b.z;
    SurfacePoint point = world.surfaces.at(hit);
    if (random.uniform() < 0.5F) face(point, -point.geometric_normal);
    const Vec3 local = sample_cosine_hemisphere({random.uniform(), random.uniform()});
    const Ray ray{leave(point), normalize(Frame(point.geometric_normal).to_world(local))};
    if (!world.caster.closest(ray, random.bits())) ++m.escaped;
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
