#include "scene/camera.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "math/sampling.h"
#include "scene/opening.h"
#include "scene/surface_samples.h"

namespace radfarm {
namespace {

/// The box that holds the middle 98 % of the surface along each axis.
Imath::Box3d bulk_box(const SurfaceSamples& samples) {
  Imath::Box3d box;
  Vec3d low(0.0);
  Vec3d high(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = samples.quantile(axis, 0.01);
    high[axis] = samples.quantile(axis, 0.99);
  }
  box.extendBy(low);
  box.extendBy(high);
  return box;
}

constexpr float kRoomFov = 1.0472F;
constexpr float kObjectFov = 0.7854F;

/// From outside, so that the opening's height, or of a wide one the width, fills a film of 16 to 9.
Camera look_through(const Opening& opening) {
  constexpr double kWide = 16.0 / 9.0;
  const double half_height = std::max(opening.half_height, opening.half_width / kWide);
  const Vec3d eye = opening.centre + opening.outwards * (half_height / std::tan(static_cast<double>(kObjectFov) / 2));
  const auto camera = place_camera(to_float(eye), to_float(opening.centre), {0, 1, 0}, kObjectFov);
  return camera ? *camera : Camera{};
}

/// At unit distance of a perspective camera, in metres of an orthographic one.
float pixel_size(const Camera& camera, int height) {
  const float half_height =
      camera.kind == Camera::Kind::kPerspective ? std::tan(camera.vertical_fov / 2) : camera.half_height;
  return 2 * half_height / static_cast<float>(height);
}

}  // namespace

Ray camera_ray(const Camera& camera, int width, int height, float x, float y) {
  const float pixel = pixel_size(camera, height);
  const float right = (x - static_cast<float>(width) / 2) * pixel;
  const float up = (static_cast<float>(height) / 2 - y) * pixel;
  const Vec3 offset = camera.right * right + camera.up * up;
  if (camera.kind == Camera::Kind::kOrthographic) return {camera.position + offset, camera.forward};
  return {camera.position, normalize(camera.forward + offset)};
}

Ray camera_ray(const Camera& camera, int width, int height, float x, float y, const Vec2& lens) {
  const Ray pinhole = camera_ray(camera, width, height, x, y);
  if (camera.kind != Camera::Kind::kPerspective || !(camera.lens_diameter > 0)) return pinhole;
  // The focus distance runs along the view, not along the ray.
  const Vec3 focus = pinhole.direction * (camera.focus_distance / dot(pinhole.direction, camera.forward));
  const Vec2 disc = sample_uniform_disk(lens) * (camera.lens_diameter / 2);
  const Vec3 offset = camera.right * disc.x + camera.up * disc.y;
  return {camera.position + offset, normalize(focus - offset)};
}

RayCone pixel_cone(const Camera& camera, int height, const Vec3& direction, std::uint32_t samples) {
  const float share = 1 / std::sqrt(static_cast<float>(samples));
  const float pixel = pixel_size(camera, height) * share;
  if (camera.kind == Camera::Kind::kOrthographic) return {pixel, 0, share};
  // A pixel off the axis is smaller across the ray, by the cosine on one axis and its square on the other.
  const float cosine = dot(direction, camera.forward);
  return {0, pixel * cosine * cosine, share};
}

double pixels_per_degree(const Camera& camera, int height) {
  constexpr double kOrthographicHeight = 45;
  constexpr double kDegree = std::numbers::pi / 180;
  const bool is_perspective = camera.kind == Camera::Kind::kPerspective;
  const double fov = is_perspective ? static_cast<double>(camera.vertical_fov) : kOrthographicHeight * kDegree;
  return height / (2 * std::tan(fov / 2) / kDegree);
}

Result<Camera> place_camera(const Vec3& eye, const Vec3& look_at, const Vec3& up, float vertical_fov) {
  if (!is_finite(eye) || !is_finite(look_at) || !is_finite(up)) {
    return fail(Code::kInvalidArgument, "camera position, target and up vector must be finite");
  }
  if (!(vertical_fov > 0 && vertical_fov < kPi)) {
    return fail(Code::kInvalidArgument, "field of view must be above 0 and below 180 degrees");
  }
  const Vec3d forward = normalize(to_double(look_at) - to_double(eye));
  if (!(length(forward) > 0)) return fail(Code::kInvalidArgument, "camera looks at the point where it stands");
  Vec3d right = cross(forward, normalize(to_double(up)));
  // An up vector along the view says nothing: the axis least along it takes its place.
  if (length(right) < 1e-6) right = cross(forward, std::fabs(forward.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1));
  Camera camera;
  camera.position = eye;
  camera.forward = to_float(forward);
  camera.right = to_float(normalize(right));
  camera.up = to_float(normalize(cross(right, forward)));
  camera.vertical_fov = vertical_fov;
  return camera;
}

Result<Camera> find_camera(const Scene& scene, std::string_view name_or_index) {
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name_or_index && !name_or_index.empty()) return camera;
  }
  std::size_t index = 0;
  const char* const end = name_or_index.data() + name_or_index.size();
  const auto [stop, error] = std::from_chars(name_or_index.data(), end, index);
  if (error == std::errc() && stop == end && index < scene.cameras.size()) return scene.cameras[index];
  std::string there;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    there += (i == 0 ? "" : ", ") + std::to_string(i) + " '" + scene.cameras[i].name + "'";
  }
  return fail(Code::kNotFound, "no camera '" + std::string(name_or_index) + "'; the scene has " +
                                   (there.empty() ? "none" : there));
}

Camera frame_scene(const Scene& scene) {
  const SurfaceSamples samples = sample_surfaces(scene);
  const Imath::Box3d box = bulk_box(samples);
  const Vec3d half = box.size() / 2.0;
  const Vec3d centre = box.center();
  const bool is_room = samples.signed_volume < 0;
  if (is_room) {
    if (const auto opening = find_opening(scene, box)) return look_through(*opening);
  }
  // In a closed room: from near a corner, a little above the middle. Otherwise: far enough for the box's sphere to fit.
  const double distance = std::max(length(half), 1e-3) / std::sin(kObjectFov / 2.0) * 1.05;
  const Vec3d outside = centre + normalize(Vec3d(1, 0.6, 1.4)) * distance;
  const Vec3d inside = centre + Vec3d(half.x * 0.7, half.y * 0.2, half.z * 0.8);
  const Vec3 eye = to_float(is_room ? inside : outside);
  const auto camera = place_camera(eye, to_float(centre), {0, 1, 0}, is_room ? kRoomFov : kObjectFov);
  return camera ? *camera : Camera{};
}

}  // namespace radfarm
