#include "scene/emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace radfarm {
namespace {

// Emission textures are averaged over n (n + 1) / 2 parts of a triangle, whose sides are cut in n.
constexpr int kLattice = 8;

Spectrum mean_radiance(const Surfaces& surfaces, std::uint32_t instance, std::uint32_t triangle) {
  SpectrumD sum;
  int count = 0;
  for (int i = 0; i < kLattice; ++i) {
    for (int j = 0; j < kLattice - i; ++j) {
      const Hit hit{instance, triangle, (static_cast<float>(i) + 1.0F / 3) / kLattice,
                    (static_cast<float>(j) + 1.0F / 3) / kLattice, 0};
      sum += SpectrumD(surfaces.emission(surfaces.at_part(hit, 1.0F / kLattice)));
      ++count;
    }
  }
  return Spectrum(sum / static_cast<double>(count));
}

double luminous_flux(const EmissiveTriangle& t) {
  return std::numbers::pi * t.area * luminance(t.mean_radiance) * (t.both_sides ? 2 : 1);
}

double luminous_flux(const PunctualEmitter& light, double radius) {
  const double intensity = luminance(light.intensity);
  if (light.table != nullptr) return intensity * zonal_lumens(*light.table);
  if (light.kind == PunctualLight::Kind::kDirectional) return std::numbers::pi * radius * radius * intensity;
  if (light.kind == PunctualLight::Kind::kPoint) return 4 * std::numbers::pi * intensity;
  // Full inside the inner cone; between the cones t^2 averages to a third over the cosine.
  return 2 * std::numbers::pi * intensity * ((1 - light.cos_inner) + (light.cos_inner - light.cos_outer) / 3);
}

void collect_triangles(const Surfaces& surfaces, std::uint32_t instance, const Shining& shining, Emitters& emitters) {
  const Mesh& mesh = surfaces.scene().meshes[surfaces.scene().instances[instance].mesh];
  const Material& material = surfaces.scene().materials[mesh.material];
  emitters.first_of_instance.push_back(kNone);
  if (material.is_switched_off) emitters.declared_triangles += mesh.triangles.size();
  if (is_black(material.emission) || !shining.material(mesh.material)) return;
  emitters.first_of_instance.back() = static_cast<std::uint32_t>(emitters.slot.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    EmissiveTriangle emitter;
    emitter.instance = instance;
    emitter.triangle = t;
    emitter.vertices = surfaces.triangle(instance, t);
    const Vec3d normal = cross(to_double(emitter.vertices[1]) - to_double(emitter.vertices[0]),
                               to_double(emitter.vertices[2]) - to_double(emitter.vertices[0]));
    emitter.area = static_cast<float>(length(normal) / 2);
    emitter.normal = to_float(normalize(normal));
    emitter.both_sides = material.emits_from_both_sides;
    emitter.mean_radiance =
        material.emission_texture.texture == kNone ? material.emission : mean_radiance(surfaces, instance, t);
    ++emitters.declared_triangles;
    const bool gives_light = emitter.area > 0 && luminance(emitter.mean_radiance) > 0;
    emitters.slot.push_back(gives_light ? static_cast<std::uint32_t>(emitters.triangles.size()) : kNone);
    if (gives_light) emitters.triangles.push_back(emitter);
  }
}

}  // namespace

std::uint32_t Emitters::find(std::uint32_t instance, std::uint32_t triangle) const {
  const std::uint32_t first = first_of_instance[instance];
  return first == kNone ? kNone : slot[first + triangle];
}

Spectrum intensity(const PunctualEmitter& light, const Vec3& way) {
  if (light.table != nullptr) return light.intensity * candela(*light.table, way, light);
  if (light.kind != PunctualLight::Kind::kSpot) return light.intensity;
  // KHR_lights_punctual: linear in the cosine between the cones, squared.
  const float width = std::max(0.001F, light.cos_inner - light.cos_outer);
  const float t = std::clamp((dot(way, light.direction) - light.cos_outer) / width, 0.0F, 1.0F);
  return light.intensity * (t * t);
}

Emitters find_emitters(const Surfaces& surfaces, const EnvironmentLight& environment, float radius, const Shining& shining) {
  Emitters emitters;
  for (std::uint32_t i = 0; i < surfaces.scene().instances.size(); ++i) collect_triangles(surfaces, i, shining, emitters);
  const std::vector<PunctualLight>& lights = surfaces.scene().lights;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const PunctualLight& light = lights[i];
    if (!(luminance(light.intensity) > 0) || !shining.light(i)) continue;
    PunctualEmitter emitter{light, nullptr, {}};
    if (light.photometry != kNone && light.kind != PunctualLight::Kind::kDirectional) {
      emitter.table = &surfaces.scene().photometries[light.photometry];
      if (!(zonal_lumens(*emitter.table) > 0)) continue;
      emitter.sampler = PhotometrySampler(*emitter.table);
    }
    emitters.punctual.push_back(std::move(emitter));
    emitters.light_of_punctual.push_back(i);
  }
  std::vector<double>& flux = emitters.flux;
  for (const EmissiveTriangle& t : emitters.triangles) flux.push_back(luminous_flux(t));
  for (const PunctualEmitter& light : emitters.punctual) flux.push_back(luminous_flux(light, radius));
  emitters.has_environment = !environment.is_empty();
  if (emitters.has_environment) {
    const double across = std::numbers::pi * static_cast<double>(radius) * static_cast<double>(radius);
    flux.push_back(across * static_cast<double>(luminance(environment.total())));
  }
  for (const double f : flux) emitters.total_flux += f;
  // A spot light whose cone is a line has intensity but no flux.
  const auto share = [&](double f) { return emitters.total_flux > 0 ? 0.9 * f / emitters.total_flux : 0; };
  std::vector<double> weights;
  for (const double f : flux) weights.push_back(share(f) + 0.1 / static_cast<double>(flux.size()));
  emitters.choice = DiscreteDistribution(weights);
  return emitters;
}

PunctualArrival arrive(const PunctualEmitter& light, const Vec3& point, float scene_radius) {
  PunctualArrival arrival;
  if (light.kind == PunctualLight::Kind::kDirectional) {
    arrival.direction = -light.direction;
    arrival.target = point + arrival.direction * (4 * scene_radius);
    arrival.irradiance = light.intensity;
    return arrival;
  }
  const Vec3 offset = light.position - point;
  const float squared = dot(offset, offset);
  if (!(squared > 0)) return arrival;
  arrival.direction = offset / std::sqrt(squared);
  arrival.target = light.position;
  arrival.irradiance = intensity(light, -arrival.direction) / squared;
  return arrival;
}

}  // namespace radfarm
