#include "paths/light_scattering.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/sampling.h"

namespace radfarm {
namespace {

// What is a surface's least probable part to be chosen, as a share: an albedo is a mean, and may be dark towards one
// side.
constexpr float kLeastChoice = 0.05F;

/// What bends light about shading normals conserves radiance; of light itself it must conserve power. [Veach 1997, 5.3]
float adjoint(const SurfacePoint& point, const Vec3& in, const Vec3& out) {
  const float up = std::fabs(dot(point.shading_normal, in) * dot(point.geometric_normal, out));
  const float down = std::fabs(dot(point.geometric_normal, in) * dot(point.shading_normal, out));
  return down > 0 ? up / down : 0;
}

ScatteredLight scatter_diffuse(const LightVertex& v, const Vec2& way) {
  const Vec3 local = sample_cosine_hemisphere(way);
  const Vec3 out = normalize(Frame(v.point.geometric_normal).to_world(local));
  // Evenly by the geometric cosine: what is left of adjoint() is the arriving side's share.
  const float below = dot(v.point.geometric_normal, v.in);
  const float bend = below > 0 ? std::max(0.0F, dot(v.point.shading_normal, v.in)) / below : 0;
  const float shape = dot(v.point.shading_normal, out) > 0 ? v.bsdf.diffuse_shape(out) : 0;
  return {{leave(v.point), out}, v.bsdf.diffuse_reflectance() * (bend * shape)};
}

ScatteredLight scatter_specular(const LightVertex& v, float lobe, const Vec2& way) {
  const Bsdf::Sample sample = v.bsdf.sample_specular(lobe, way);
  if (is_black(sample.weight)) return {};
  const bool agree =
      dot(v.point.shading_normal, sample.direction) * dot(v.point.geometric_normal, sample.direction) > 0;
  if (!agree) return {};
  return {{leave(v.point, sample.direction), sample.direction},
          sample.weight * adjoint(v.point, v.in, sample.direction),
          true};
}

ScatteredLight go_straight(const LightVertex& v) {
  return {{leave(v.point, -v.in), -v.in}, v.straight, true, true};
}

}  // namespace

LightVertex::LightVertex(const World& world, const Hit& hit, const Vec3& back)
    : point(world.surfaces.at(hit)), in(back), bsdf(scattering(world, hit)) {}

Bsdf LightVertex::scattering(const World& world, const Hit& hit) {
  face(point, in);
  Bsdf made = bsdf_at(world.surfaces, point, in);
  if (world.surfaces.is_pane(world.scene.instances[hit.instance].mesh)) {
    straight = pane_passage(world.surfaces.matter(point), std::fabs(dot(point.geometric_normal, in)));
  }
  return made;
}

ScatteredLight scatter_light(const LightVertex& v, const Spectrum& power, const ScatteringNumbers& numbers) {
  std::array<float, 3> share{luminance(power * v.bsdf.diffuse_reflectance()),
                             v.bsdf.has_specular() ? luminance(power * v.bsdf.specular_albedo()) : 0,
                             luminance(power * v.straight)};
  const float total = share[0] + share[1] + share[2];
  if (!(total > 0)) return {};
  float sum = 0;
  for (float& s : share) sum += s = s > 0 ? std::max(s, kLeastChoice * total) : 0;
  const float choice = numbers.part * sum;
  const std::size_t part = choice < share[0] ? 0 : (choice < share[0] + share[1] || !(share[2] > 0) ? 1 : 2);
  if (!(share[part] > 0)) return {};
  ScatteredLight scattered = part == 0   ? scatter_diffuse(v, numbers.way)
                             : part == 1 ? scatter_specular(v, numbers.lobe, numbers.way)
                                         : go_straight(v);
  scattered.weight *= sum / share[part];
  return scattered;
}

}  // namespace radfarm
