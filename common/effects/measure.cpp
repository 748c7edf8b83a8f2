#include "effects/measure.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "effects/detail.h"
#include "effects/texture_range.h"
#include "scene/photometry.h"

namespace radfarm {
namespace {

float deviation(const Spectrum& s) {
  const float mean = luminance(s);
  return mean > 0 ? std::max(max_component(s) / mean - 1, 1 - min_component(s) / mean) : 0;
}

/// The whole material, its textures taken as 1.
Matter fullest(const Material& m) {
  return {m.base_color,        m.metallic,  m.roughness,           m.specular,    m.specular_color,    m.ior,        m.transmission,
          m.has_volume,        m.clearcoat, m.clearcoat_roughness, m.sheen_color, m.sheen_roughness, m.anisotropy, m.anisotropy_rotation};
}

void count_layers(const Material& material, Measurements& m) {
  const Matter matter = fullest(material);
  if (matter.is_lambertian()) return;
  Matter bare = matter;
  bare.base = matter.base * matter.metallic;  // what is left is specular
  m.max_specular = std::max(m.max_specular, max_component(mean_reflectance(bare)));
  m.metals += matter.metallic > 0 ? 1 : 0;
  m.mirrors += is_smooth(matter.roughness) && (matter.metallic > 0 || matter.specular > 0) ? 1 : 0;
  m.glossy += !is_smooth(matter.roughness) && (matter.metallic > 0 || matter.specular > 0) ? 1 : 0;
  m.coats += matter.clearcoat > 0 ? 1 : 0;
  m.mirror_coats += matter.clearcoat > 0 && is_smooth(matter.clearcoat_roughness) ? 1 : 0;
  m.sheens += is_black(matter.sheen) ? 0 : 1;
  m.anisotropic += matter.anisotropy > 0 ? 1 : 0;
  if (matter.transmission == 0) return;
  m.volumes += matter.has_volume ? 1 : 0;
  m.panes += matter.is_pane() ? 1 : 0;
  m.rough_transmitters += !matter.has_volume && !matter.is_pane() ? 1 : 0;
  m.max_transmission = std::max(m.max_transmission, matter.transmission);
}

void measure_textures(const Scene& scene, const Material& material, Measurements& m) {
  if (material.base_texture.is_used()) {
    const TextureRange range = range_of(scene.textures[material.base_texture.texture]);
    m.texture_deviation = std::max(m.texture_deviation, max_component(material.base_color * range.deviation));
    m.color_deviation = std::max(m.color_deviation, range.color_deviation);
    ++m.reflectance_textures;
    if (material.alpha_mode != Material::Alpha::kOpaque) {
      m.least_coverage = std::min(m.least_coverage, material.alpha * range.least_alpha);
    }
  } else if (material.alpha_mode != Material::Alpha::kOpaque) {
    m.least_coverage = std::min(m.least_coverage, material.alpha);
  }
  if (material.emission_texture.is_used() && !is_black(material.emission)) {
    const TextureRange range = range_of(scene.textures[material.emission_texture.texture]);
    m.emission_contrast = std::max(m.emission_contrast, luminance(material.emission * range.deviation));
    ++m.emission_textures;
  }
  if (material.normal_texture.is_used()) {
    const Texture& map = scene.textures[material.normal_texture.texture];
    m.normal_map_angle = std::max(m.normal_map_angle, largest_angle(map, material.normal_scale));
    ++m.normal_maps;
  }
}

void measure_materials(const Scene& scene, Measurements& m) {
  std::set<std::uint32_t> used;
  for (const Instance& instance : scene.instances) used.insert(scene.meshes[instance.mesh].material);
  for (const std::uint32_t id : used) {
    const Material& material = scene.materials[id];
    m.max_reflectance = std::max(m.max_reflectance, max_component(mean_reflectance(fullest(material))));
    m.color_deviation = std::max(m.color_deviation, deviation(material.base_color));
    m.max_radiance = std::max(m.max_radiance, luminance(material.emission));
    m.dispersive += material.asks_for(Material::kDispersion) ? 1 : 0;
    m.iridescent += material.asks_for(Material::kIridescence) ? 1 : 0;
    m.scattering += material.asks_for(Material::kScatteringInside) ? 1 : 0;
    count_layers(material, m);
    measure_textures(scene, material, m);
  }
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode == Material::Alpha::kOpaque) continue;
    for (const auto& color : mesh.colors) m.least_coverage = std::min(m.least_coverage, color[3]);
  }
}

void measure_light(const World& world, Measurements& m) {
  m.emissive_triangles = world.emitters.declared_triangles;
  m.punctual_lights = world.scene.lights.size();
  m.has_environment = !world.scene.environment.is_empty();
  m.emitted_flux = world.emitters.total_flux;
  if (!world.environment.is_empty()) m.max_radiance = std::max(m.max_radiance, world.environment.max_luminance());
  std::vector<Spectrum> lights;
  for (const EmissiveTriangle& t : world.emitters.triangles) lights.push_back(t.mean_radiance);
  for (const PunctualEmitter& l : world.emitters.punctual) lights.push_back(l.intensity);
  if (!world.environment.is_empty()) lights.push_back(world.environment.total());
  Spectrum brightest;
  for (const Spectrum& l : lights) {
    m.flux_color_deviation = std::max(m.flux_color_deviation, deviation(l));
    brightest = {std::max(brightest.r, l.r), std::max(brightest.g, l.g), std::max(brightest.b, l.b)};
  }
  m.dark_channels = static_cast<std::size_t>((brightest.r == 0 ? 1 : 0) + (brightest.g == 0 ? 1 : 0) + (brightest.b == 0 ? 1 : 0));
  for (const PunctualEmitter& light : world.emitters.punctual) {
    if (light.table == nullptr) continue;
    ++m.ies_lights;
    const double mean = zonal_lumens(*light.table) / (4 * static_cast<double>(kPi));
    m.ies_contrast = std::max(m.ies_contrast, static_cast<float>(static_cast<double>(max_candela(*light.table)) / mean - 1));
  }
}

}  // namespace

Measurements measure(const World& world, const ViewSize& view, std::uint64_t seed, const Progress& progress) {
  Measurements m;
  measure_light(world, m);
  progress.report("effects: materials");
  measure_materials(world.scene, m);
  progress.report("effects: pilot");
  m.pilot = run_pilot(world, view.camera, view.width, view.height, seed);
  const bool is_specular = m.metals + m.glossy + m.mirrors + m.coats + m.sheens + m.volumes + m.panes + m.rough_transmitters > 0;
  if (is_specular && world.emitters.size() > 0) m.specular = measure_specular_shares(world, seed);
  m.detail_elevation = detail_elevation(world, view.camera, view.width, view.height, kMaxElevation);
  progress.report("effects: trapped light");
  m.trapped = find_trapped_light(world, seed);
  return m;
}

}  // namespace radfarm
