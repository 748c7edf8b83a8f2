#include "estimate/mesh_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimate/eye_chain.h"
#include "radiosity/element_point.h"

namespace radfarm {
namespace {

constexpr float kDarkest = 0.2F;  // what a line leaves of the light: it shows in bright and dark places alike

/// How the point of a plane that a film point shows moves, to first order, when the film point moves by a pixel along `across`.
Vec3d step_on_plane(const Film& film, const Vec3d& position, const Vec3d& normal, const Vec3& across) {
  const Camera& camera = film.camera;
  const bool is_perspective = camera.kind == Camera::Kind::kPerspective;
  const Vec3d view = is_perspective ? position - to_double(camera.position) : to_double(camera.forward);
  const double depth = dot(position - to_double(camera.position), to_double(camera.forward));
  const double half_height = is_perspective ? depth * std::tan(static_cast<double>(camera.vertical_fov) / 2)
                                            : static_cast<double>(camera.half_height);
  const Vec3d step = to_double(across) * (2 * half_height / film.height);
  return step - view * (dot(step, normal) / dot(view, normal));
}

void scale(RadianceParts& parts, float factor) {
  for (Spectrum* part : {&parts.emission, &parts.direct, &parts.indirect, &parts.specular}) *part *= factor;
}

float coverage(const GouraudContext& context, const Film& film, const Ray& ray, std::uint64_t key) {
  const auto hit = context.world.caster.closest_with_panes(ray, key);
  if (!hit) return 0;
  SurfacePoint point = context.world.surfaces.at(*hit);
  face(point, -ray.direction);
  const ElementPoint at = locate(context.mesh, context.sides, context.world.surfaces, *hit, point);
  if (at.element == kNone) return 0;
  const TriangleVertices corners = corners_of(context.mesh, context.mesh.elements[at.element]);
  return std::max(0.0F, 1 - pixels_to_edge(corners, point.position, film));
}

}  // namespace

float pixels_to_edge(const TriangleVertices& triangle, const Vec3& position, const Film& film) {
  const Vec3d p = to_double(position);
  const Vec3d normal = cross(to_double(triangle[1]) - to_double(triangle[0]), to_double(triangle[2]) - to_double(triangle[0]));
  const Vec3d dx = step_on_plane(film, p, normal, film.camera.right), dy = step_on_plane(film, p, normal, film.camera.up);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    // The distance to the edge, and how it grows on the film.
    const Vec3d a = to_double(triangle[k]), edge = to_double(triangle[(k + 1) % 3]) - a;
    const Vec3d inwards = cross(normal, edge);
    const double growth = std::hypot(dot(inwards, dx), dot(inwards, dy));
    nearest = std::min(nearest, std::fabs(dot(inwards, p - a)) / growth);
  }
  return std::isnan(nearest) ? std::numeric_limits<float>::infinity() : static_cast<float>(nearest);
}

SampleRadiance with_mesh_lines(SampleRadiance radiance, const GouraudContext& context, const Film& film) {
  return [inner = std::move(radiance), context, film](const Ray& ray, const PixelSampler& sampler, Counters& counters,
                                                     FirstSurface* first) {
    RadianceParts parts = inner(ray, sampler, counters, first);
    ++counters.camera_rays;
    scale(parts, 1 - (1 - kDarkest) * coverage(context, film, ray, sampler.key(kCoverageDimension)));
    return parts;
  };
}

}  // namespace radfarm
